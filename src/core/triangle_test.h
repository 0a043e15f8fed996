// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/double_test.h"
#include "core/exact_test.h"
#include "core/float_mode.h"

namespace umbrix::detail {

/// The true answer for one ray and one triangle: double, then integers. `counts` hears of each stage.
template <class Counts>
bool hits(const Ray& ray, const Triangle& triangle, Counts& counts) noexcept {
  const DefaultFloatMode mode;
  counts.double_test();
  const Verdict verdict = test_in_double(ray, triangle).verdict;
  if (verdict != Verdict::undecided) return verdict == Verdict::hit;
  counts.exact_test();
  return hits_exactly(ray, triangle);
}

/// A hit with its distance enclosed, so that hits can be ordered without rounding.
struct OrderedHit {
  double t_low, t_high;
  HitParameters parameters;
};

/// As hits(), and fills `hit` if there is one. The parameters are the same whichever stage decided.
template <class Counts>
bool hits(const Ray& ray, const Triangle& triangle, OrderedHit& hit, Counts& counts) noexcept {
  const DefaultFloatMode mode;
  counts.double_test();
  const DoubleTest x = test_in_double(ray, triangle);
  if (x.verdict == Verdict::miss) return false;
  if (x.verdict == Verdict::undecided) {
    counts.exact_test();
    if (!hits_exactly(ray, triangle)) return false;
  }
  if (x.det < 64 * x.det_error) {
    hit.parameters = exact_parameters(ray, triangle);
    const double slack = 0x1p-48 * std::abs(hit.parameters.t) + 0x1p-1000;
    hit.t_low = hit.parameters.t - slack;
    hit.t_high = hit.parameters.t + slack;
    return true;
  }
  const double t = x.t / x.det;
  const double radius = 1.001 * (x.t_error + std::abs(t) * x.det_error) / (x.det - x.det_error) + 0x1p-50 * std::abs(t);
  hit.parameters = {t, std::clamp(x.u / x.det, 0.0, 1.0), std::clamp(x.v / x.det, 0.0, 1.0)};
  hit.t_low = t - radius;
  hit.t_high = t + radius;
  return true;
}

/// Does hit a come before hit b? Equal distances are told apart by the ids, lowest first.
template <class Id>
bool comes_before(const Ray& ray, const OrderedHit& a, const Triangle& triangle_a, Id id_a, const OrderedHit& b,
                  const Triangle& triangle_b, Id id_b) noexcept {
  if (a.t_high < b.t_low) return true;
  if (b.t_high < a.t_low) return false;
  const int order = compare_t_exactly(ray, triangle_a, triangle_b);
  return order != 0 ? order < 0 : id_a < id_b;
}

}  // namespace umbrix::detail
