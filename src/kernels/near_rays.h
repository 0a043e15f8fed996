// SPDX-License-Identifier: Apache-2.0
// How near rays of a call are to the ones before, as some of them tell: whether a walk that they share will pay.
#pragma once

#include <algorithm>
#include <glm/geometric.hpp>

#include "core/math.h"
#include "kernels/ray_class.h"
#include "tree/tree.h"
#include "umbrix/ray.h"

namespace umbrix::detail {

/// Are three in four rays, of those looked at, like the one before? is_like(a, b) tells.
template <class IsLike>
bool most_are_like_the_one_before(const RaySpan& rays, const IsLike& is_like) noexcept {
  constexpr std::size_t kSamples = 16;
  if (rays.count < 2) return false;
  std::size_t like = 0;
  for (std::size_t sample = 0; sample < kSamples; ++sample) {
    // Not all at the ends of blocks of pixels.
    const std::size_t i = std::min(sample * (rays.count - 1) / kSamples + sample, rays.count - 2);
    like += is_like(rays[i], rays[i + 1]) ? 1 : 0;
  }
  return 4 * like >= 3 * kSamples;
}

/// Do they start near each other, for the scene's size? Not if one is NaN.
inline bool start_near(const Ray& a, const Ray& b, const Tree& tree) noexcept {
  constexpr float kPart = 1.0f / 64;
  const float scale = power_of_two(std::clamp(tree.scale_exponent, -126, 126));
  const Vec3 way(b.origin[0] - a.origin[0], b.origin[1] - a.origin[1], b.origin[2] - a.origin[2]);
  return glm::length(way * scale) < kPart * tree.root.largest_extent();
}

/// As those of a tile to the sun: near each other, and of nearly one direction.
inline bool go_together(const RaySpan& rays, const Tree& tree) noexcept {
  return most_are_like_the_one_before(rays, [&](const Ray& a, const Ray& b) {
    constexpr float kSine = 0.1f;
    const Vec3 da(a.direction[0], a.direction[1], a.direction[2]), db(b.direction[0], b.direction[1], b.direction[2]);
    return start_near(a, b, tree) && glm::dot(da, db) > 0 &&
           glm::length(glm::cross(da, db)) < kSine * glm::length(da) * glm::length(db);
  });
}

/// As those of a tile of pixels: among rays so dense many meet the same triangles.
inline bool start_densely(const RaySpan& rays, const Tree& tree) noexcept {
  return most_are_like_the_one_before(rays, [&](const Ray& a, const Ray& b) { return start_near(a, b, tree); });
}

}  // namespace umbrix::detail
