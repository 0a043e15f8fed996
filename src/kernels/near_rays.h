// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/geometric.hpp>

#include "core/math.h"
#include "kernels/ray_class.h"
#include "tree/tree.h"
#include "umbrix/ray.h"

namespace umbrix::detail {

/// Are most rays near the one before and of nearly its direction, as those of a tile to the sun? Then groups share much
/// of their walk. Looks at some only.
inline bool go_together(const RaySpan& rays, const Tree& tree) noexcept {
  constexpr std::size_t kSamples = 16;
  constexpr float kNear = 1.0f / 16, kSine = 0.1f;
  if (rays.count < 2) return false;
  const float near = kNear * tree.root.largest_extent();
  const float scale = power_of_two(std::clamp(tree.scale_exponent, -126, 126));
  std::size_t together = 0;
  for (std::size_t sample = 0; sample < kSamples; ++sample) {
    const std::size_t i = sample * (rays.count - 1) / kSamples;
    const Ray &a = rays[i], &b = rays[i + 1];
    const Vec3 way =
        (Vec3(b.origin[0], b.origin[1], b.origin[2]) - Vec3(a.origin[0], a.origin[1], a.origin[2])) * scale;
    const Vec3 da(a.direction[0], a.direction[1], a.direction[2]), db(b.direction[0], b.direction[1], b.direction[2]);
    const float lengths = glm::length(da) * glm::length(db);
    // Comparisons with NaN fail.
    together += glm::length(way) < near && glm::dot(da, db) > 0 && glm::length(glm::cross(da, db)) < kSine * lengths;
  }
  return 4 * together >= 3 * kSamples;
}

}  // namespace umbrix::detail
