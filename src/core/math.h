// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>

namespace umbrix::detail {

using Vec3 = glm::vec3;
using DVec3 = glm::dvec3;

/// Three vertices, exactly as the host gave them.
struct Triangle {
  Vec3 v[3];
};

inline bool is_finite(const Triangle& triangle) noexcept {
  for (const Vec3& v : triangle.v)
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) return false;
  return true;
}

/// A closed axis-aligned box; empty while lower > upper on some axis.
struct Box {
  Vec3 lower{std::numeric_limits<float>::infinity()};
  Vec3 upper{-std::numeric_limits<float>::infinity()};

  void extend(const Vec3& p) noexcept {
    lower = glm::min(lower, p);
    upper = glm::max(upper, p);
  }
  void extend(const Box& b) noexcept {
    lower = glm::min(lower, b.lower);
    upper = glm::max(upper, b.upper);
  }
  Vec3 extent() const noexcept { return upper - lower; }
  float largest_extent() const noexcept {
    const Vec3 e = extent();
    return std::max(e.x, std::max(e.y, e.z));
  }
  bool empty() const noexcept { return !(lower.x <= upper.x && lower.y <= upper.y && lower.z <= upper.z); }
};

/// Half the surface area, in double so that no scene scale can overflow or vanish.
inline double half_area(const Box& b) noexcept {
  const DVec3 e = DVec3(b.upper) - DVec3(b.lower);
  return e.x * e.y + e.y * e.z + e.z * e.x;
}

}  // namespace umbrix::detail
