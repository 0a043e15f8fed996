// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <vector>

#include "oracle/double_filter.h"
#include "oracle/float_mode.h"

/// The queries of all oracles, over whatever names the triangles that a ray may hit.
namespace umbrix::oracle {

/// Says whether a triangle is there for a query; asked only for triangles that may be hit. Empty: all are.
using Visible = std::function<bool(std::uint32_t)>;

struct Closest {
  std::uint32_t triangle;
  double t, u, v;  ///< correct to a double's last bits
};

/// for_each_near(body) calls body(i) for triangles, until it returns false; none that the ray hits may be left out.
template <typename ForEachNear>
bool decide_occluded(const Ray& ray, const std::vector<Triangle>& triangles, const Visible& visible,
                     const ForEachNear& for_each_near) {
  const DefaultFloatMode mode;
  if (!is_valid(ray)) return false;
  bool hit = false;
  std::vector<std::uint32_t> open;
  for_each_near([&](std::uint32_t i) {
    const Verdict verdict = filter(ray, triangles[i]).verdict;
    if (verdict == Verdict::miss || (visible && !visible(i))) return true;
    if (verdict == Verdict::open) open.push_back(i);
    hit = verdict == Verdict::hit;
    return !hit;
  });
  return hit || std::any_of(open.begin(), open.end(), [&](std::uint32_t i) { return exact_hit(ray, triangles[i].v); });
}

/// The smallest t; among equals the lowest triangle.
template <typename ForEachNear>
std::optional<Closest> decide_closest(const Ray& ray, const std::vector<Triangle>& triangles, const Visible& visible,
                                      const ForEachNear& for_each_near) {
  const DefaultFloatMode mode;
  if (!is_valid(ray)) return std::nullopt;
  struct Candidate {
    std::uint32_t triangle;
    double t_lower, t_upper;
  };
  std::vector<Candidate> candidates;
  for_each_near([&](std::uint32_t i) {
    const Filtered f = filter(ray, triangles[i]);
    if (f.verdict != Verdict::miss && (!visible || visible(i))) candidates.push_back({i, f.t_lower, f.t_upper});
    return true;
  });
  // Nearest first, so that most others are certainly farther than the best so far.
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& x, const Candidate& y) { return x.t_lower < y.t_lower; });
  std::optional<ExactHit> best;
  Candidate nearest{};
  for (const Candidate& candidate : candidates) {
    if (best && candidate.t_lower > nearest.t_upper) break;
    std::optional<ExactHit> hit = exact_intersection(ray, triangles[candidate.triangle].v);
    if (!hit) continue;
    const int order = best ? compare_t(*hit, *best) : -1;
    if (order < 0 || (order == 0 && candidate.triangle < nearest.triangle)) {
      best = std::move(hit);
      nearest = candidate;
    }
  }
  if (!best) return std::nullopt;
  return Closest{nearest.triangle, best->t(), best->u(), best->v()};
}

}  // namespace umbrix::oracle
