// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "tree/tree.h"

namespace umbrix::detail {

/// A bound for the walk's floats: rounded up, with room for its eps.
inline float bound(double x) noexcept { return static_cast<float>(x * (1 + 0x1p-18)); }

/// Writes a triangle, in the tree's units, into a lane of a block, and raises the block's edge bound for it. Count and
/// reach are the caller's.
inline void pack_lane(std::uint32_t id, const Triangle& scaled, std::uint32_t lane, Block& block) noexcept {
  const Vec3 e1 = scaled.v[1] - scaled.v[0], e2 = scaled.v[2] - scaled.v[0];
  for (int axis = 0; axis < 3; ++axis) {
    block.v0[axis][lane] = scaled.v[0][axis];
    block.e1[axis][lane] = e1[axis];
    block.e2[axis][lane] = e2[axis];
  }
  block.id[lane] = id;
  const double longest = std::max(glm::length(DVec3(e1)), glm::length(DVec3(e2)));
  block.edge_bound = std::max(block.edge_bound, bound(longest));
}

/// Fills a block with 1 to kBlockLanes triangles, where `scaled(id)` is one in the tree's units. Their first vertices
/// are within the longest edge plus `distance` of every point from which the block will be tested.
template <class Scaled>
void pack_block(const std::uint32_t* ids, std::uint32_t count, Scaled&& scaled, float distance, Block& block) {
  block.edge_bound = 0;
  for (std::uint32_t lane = 0; lane < kBlockLanes; ++lane) {
    const std::uint32_t id = ids[lane < count ? lane : 0];
    pack_lane(id, scaled(id), lane, block);
  }
  block.count = count;
  block.reach = bound(static_cast<double>(block.edge_bound) + static_cast<double>(distance));
}

}  // namespace umbrix::detail
