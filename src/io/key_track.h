// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <vector>

namespace umbrix::io::detail {

/// A place among ascending times: `u`, from 0 to below 1, of the way from a key to the next, `span` later. At a key,
/// and beyond the ends, u is 0.
struct KeyPlace {
  std::size_t key = 0;
  double u = 0;
  double span = 0;
};

/// `times` must not be empty.
inline KeyPlace find_place(const std::vector<double>& times, double time) {
  if (!(time > times.front())) return {0, 0, 0};
  if (!(time < times.back())) return {times.size() - 1, 0, 0};
  const auto next = std::upper_bound(times.begin(), times.end(), time);
  const double before = *(next - 1);
  return {static_cast<std::size_t>(next - times.begin()) - 1, (time - before) / (*next - before), *next - before};
}

/// From `a` with slope `a_slope` to `b` with slope `b_slope` over a time of `span` (Hermite's cubic).
template <class V>
V hermite(const V& a, const V& a_slope, const V& b, const V& b_slope, double u, double span) {
  const double uu = u * u, uuu = uu * u;
  return a * (2 * uuu - 3 * uu + 1) + a_slope * ((uuu - 2 * uu + u) * span) + b * (3 * uu - 2 * uuu) +
         b_slope * ((uuu - uu) * span);
}

inline double blend(double a, double b, double u) { return a + (b - a) * u; }
inline glm::dvec3 blend(const glm::dvec3& a, const glm::dvec3& b, double u) { return a + (b - a) * u; }

/// Along the shorter arc.
inline glm::dquat blend(const glm::dquat& a, const glm::dquat& b, double u) { return glm::slerp(a, b, u); }

enum class Interpolation { step, linear, cubic_spline };

/// When the keys of a track are: ascending, at least one. Tracks of an animation often share them.
using KeyTimes = std::shared_ptr<const std::vector<double>>;

/// An animated value, or `count` of them that share their times (glTF 2.0, appendix C): a key has one row of `count`
/// values, of a cubic spline three: the slopes on the way in, the values, the slopes on the way out.
template <class V>
struct KeyTrack {
  Interpolation interpolation = Interpolation::linear;
  KeyTimes times;
  std::vector<V> values;
  std::size_t count = 1;

  /// Value number i of the row. Rotations are not made unit length.
  V at(double time, std::size_t i = 0) const {
    const KeyPlace place = find_place(*times, time);
    const bool cubic = interpolation == Interpolation::cubic_spline;
    const V* value = &values[(cubic ? 3 * place.key + 1 : place.key) * count + i];
    if (place.u == 0 || interpolation == Interpolation::step) return *value;
    if (!cubic) return blend(*value, value[count], place.u);
    return hermite(*value, value[count], value[3 * count], value[2 * count], place.u, place.span);
  }
};

}  // namespace umbrix::io::detail
