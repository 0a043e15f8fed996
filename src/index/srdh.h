// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "index/side_table.h"
#include "index/training_rays.h"
#include "tree/tree.h"
#include "umbrix/executor.h"

namespace umbrix::detail {

/// A node of a bounding volume hierarchy in the order of visits: an inner node's first child comes right after it.
/// A leaf names one block. The box holds the triangles' boxes grown by the tree's eps.
struct SrdhNode {
  static constexpr std::uint32_t kInner = 0xFFFFFFFFu;

  float faces[kFaces];
  std::uint32_t skip;   ///< nodes of its subtree: how far to the next node if the box is missed
  std::uint32_t block;  ///< or kInner

  bool is_leaf() const noexcept { return block != kInner; }
};
static_assert(sizeof(SrdhNode) == 32);

/// A hierarchy built for occlusion queries from rays like those to come and what blocks them. Each inner node has its
/// own order of visits, the same for every ray, so that the walk needs no stack.
class Srdh : public SideTable {
 public:
  /// `scaled` are the triangles in the tree's units, `kept` those that can be hit (at least one). Without training rays
  /// the hierarchy is that of the surface area heuristic. Throws std::bad_alloc.
  Srdh(const std::vector<Triangle>& scaled, std::vector<std::uint32_t> kept, float eps, const TrainingRays& training,
       const Executor* executor);

  const std::vector<SrdhNode>& nodes() const noexcept { return nodes_; }
  const Block& block(const SrdhNode& leaf) const noexcept { return blocks_[leaf.block]; }
  std::uint64_t bytes() const noexcept override {
    return nodes_.size() * sizeof(SrdhNode) + blocks_.size() * sizeof(Block);
  }

 private:
  std::vector<SrdhNode> nodes_;
  std::vector<Block> blocks_;
};

}  // namespace umbrix::detail
