// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/math.h"

namespace umbrix::detail {

/// One coordinate of a vertex that an instance places: what an instance is, so this is the one expression for it (in
/// lanes: instance_leaf-inl.h). Contraction is off.
inline float placed(const double (&row)[4], const Vec3& p) noexcept {
  return static_cast<float>(row[0] * static_cast<double>(p.x) + row[1] * static_cast<double>(p.y) +
                            row[2] * static_cast<double>(p.z) + row[3]);
}

inline Vec3 placed(const double (&to_world)[3][4], const Vec3& p) noexcept {
  return {placed(to_world[0], p), placed(to_world[1], p), placed(to_world[2], p)};
}

inline Triangle placed(const double (&to_world)[3][4], const Triangle& t) noexcept {
  return {{placed(to_world, t.v[0]), placed(to_world, t.v[1]), placed(to_world, t.v[2])}};
}

}  // namespace umbrix::detail
