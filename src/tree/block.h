// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "tree/tree.h"

namespace umbrix::detail {

/// A bound for the walk's floats: rounded up, with room for its eps.
inline float bound(double x) noexcept { return static_cast<float>(x * (1 + 0x1p-18)); }

/// Fills a block with 1 to kBlockLanes triangles, where `scaled(id)` is one in the tree's units. Their first vertices
/// are within the longest edge plus `distance` of every point from which the block will be tested.
template <class Scaled>
void pack_block(const std::uint32_t* ids, std::uint32_t count, Scaled&& scaled, float distance, Block& block) {
  double longest = 0;
  for (std::uint32_t lane = 0; lane < kBlockLanes; ++lane) {
    const std::uint32_t id = ids[lane < count ? lane : 0];
    const Triangle& t = scaled(id);
    const Vec3 e1 = t.v[1] - t.v[0], e2 = t.v[2] - t.v[0];
    for (int axis = 0; axis < 3; ++axis) {
      block.v0[axis][lane] = t.v[0][axis];
      block.e1[axis][lane] = e1[axis];
      block.e2[axis][lane] = e2[axis];
    }
    block.id[lane] = id;
    longest = std::max({longest, glm::length(DVec3(e1)), glm::length(DVec3(e2))});
  }
  block.count = count;
  block.edge_bound = bound(longest);
  block.reach = bound(longest + static_cast<double>(distance));
}

}  // namespace umbrix::detail
