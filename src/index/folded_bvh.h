// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "core/lazy_array.h"
#include "index/triangle_bvh.h"

namespace umbrix::detail {

/// Boxes of up to sixteen descendants of a node, the largest first. What is left over has a box that nothing meets.
struct alignas(64) FoldedNode {
  float lower[3][kRowLanes], upper[3][kRowLanes];
  std::uint32_t child[kRowLanes];  ///< a folded node, or BvhNode::kLeaf with the place of one of the hierarchy's rows
};

/// The hierarchy of boxes with its levels folded, for rays and bundles that walk by themselves: sixteen boxes are
/// tested at once. The largest children are taken apart first (Wald, Benthin & Boulos 2008, "Getting rid of packets").
class FoldedBvh {
 public:
  static constexpr std::uint32_t kWidth = kRowLanes;

  FoldedBvh() = default;
  /// `bvh` must outlive it, where it is. Throws std::bad_alloc.
  explicit FoldedBvh(const TriangleBvh& bvh);

  std::uint64_t bytes() const noexcept { return count_ * sizeof(FoldedNode); }

  /// Node 0 is the root; there is none if there are no triangles.
  bool empty() const noexcept { return count_ == 0; }
  const FoldedNode& node(std::uint32_t index) const noexcept { return nodes_[index]; }
  const TriangleRows& rows(std::uint32_t index) const noexcept { return bvh_->rows(index); }

 private:
  const TriangleBvh* bvh_ = nullptr;
  LazyArray<FoldedNode> nodes_;  ///< room for as many as the hierarchy has: it does not move as it grows
  std::size_t count_ = 0;
};

}  // namespace umbrix::detail
