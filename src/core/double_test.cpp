// SPDX-License-Identifier: Apache-2.0
// Moeller & Trumbore's (1997) determinants, with the origin moved to a vertex and each value bounded by the permanent
// of its products (the filter idea of Shewchuk 1997). Products of degree four in floats neither overflow nor vanish
// in double, so the bounds need no absolute term.

#include "core/double_test.h"

#include <cmath>

namespace umbrix::detail {
namespace {

constexpr double kUnit = 0x1p-53;
// gamma_7 and gamma_9 with room to spare: det, U, V are sums of products of once-rounded differences.
constexpr double kEdge = 8 * kUnit;
constexpr double kSum = 10 * kUnit;

/// a x b and, componentwise, the sums of the products' absolute values.
struct Cross {
  DVec3 value;
  DVec3 permanent;
};

Cross cross(const DVec3& a, const DVec3& b) noexcept {
  const DVec3 plus(a.y * b.z, a.z * b.x, a.x * b.y);
  const DVec3 minus(a.z * b.y, a.x * b.z, a.y * b.x);
  return {plus - minus, glm::abs(plus) + glm::abs(minus)};
}

/// A value and the bound of its error; a bound of zero means that the value is exact (and zero).
struct Bounded {
  double value;
  double permanent;
};

Bounded dot(const DVec3& a, const Cross& c) noexcept {
  return {a.x * c.value.x + a.y * c.value.y + a.z * c.value.z,
          std::abs(a.x) * c.permanent.x + std::abs(a.y) * c.permanent.y + std::abs(a.z) * c.permanent.z};
}

DVec3 vec(const float* p) noexcept { return {p[0], p[1], p[2]}; }

/// Is numerator - end * det positive (+1), not positive (-1), or unknown (0)?
int beyond(double numerator, double numerator_permanent, double end, double det, double det_permanent) noexcept {
  if (std::isinf(end)) return end < 0 ? 1 : -1;
  const double permanent = numerator_permanent + std::abs(end) * det_permanent;
  if (permanent == 0) return -1;
  const double value = numerator - end * det;
  const double error = kSum * permanent;
  return value > error ? 1 : value < -error ? -1 : 0;
}

}  // namespace

DoubleTest test_in_double(const Ray& ray, const Triangle& triangle) noexcept {
  const DVec3 v0(triangle.v[0]);
  const DVec3 e1 = DVec3(triangle.v[1]) - v0;
  const DVec3 e2 = DVec3(triangle.v[2]) - v0;
  const DVec3 d = vec(ray.direction);
  const DVec3 s = vec(ray.origin) - v0;

  const Cross p = cross(d, e2);
  const Cross q = cross(s, e1);
  const Bounded det = dot(e1, p);
  const Bounded u = dot(s, p);
  const Bounded v = dot(d, q);
  const Bounded t = dot(e2, q);

  const double sign = det.value < 0 ? -1.0 : 1.0;
  DoubleTest result;
  result.det = sign * det.value;
  result.u = sign * u.value;
  result.v = sign * v.value;
  result.t = sign * t.value;
  result.det_error = kEdge * det.permanent;
  result.t_error = kEdge * t.permanent;
  const double w = (result.det - result.u) - result.v;

  const double u_error = kEdge * u.permanent;
  const double v_error = kEdge * v.permanent;
  const double w_permanent = det.permanent + u.permanent + v.permanent;
  const double w_error = kSum * w_permanent;

  if (det.permanent == 0) {
    result.verdict = Verdict::miss;
    return result;
  }
  if (result.det <= result.det_error) {
    // The sign of det is unknown. u + v + w = det >= 0 as computed, so one value far below zero forces another
    // above it: their true signs differ, a miss for either sign.
    const double error = std::max({u_error, v_error, w_error});
    if (std::min({result.u, result.v, w}) < -2.0002 * error) result.verdict = Verdict::miss;
    return result;
  }
  if (result.u < -u_error || result.v < -v_error || w < -w_error) {
    result.verdict = Verdict::miss;
    return result;
  }
  const int after_start = beyond(result.t, t.permanent, ray.tmin, result.det, det.permanent);
  const int before_end = -beyond(result.t, t.permanent, ray.tmax, result.det, det.permanent);
  // A zero permanent is an exact zero at an end, and the interval is open: beyond() then says -1 for both ends.
  const bool end_is_exact = t.permanent == 0 && ray.tmax == 0;
  if (after_start < 0 || before_end < 0 || end_is_exact) {
    result.verdict = Verdict::miss;
    return result;
  }
  const bool inside = (result.u > u_error || u.permanent == 0) && (result.v > v_error || v.permanent == 0) &&
                      (w > w_error || w_permanent == 0);
  if (inside && after_start > 0 && before_end > 0) result.verdict = Verdict::hit;
  return result;
}

}  // namespace umbrix::detail
