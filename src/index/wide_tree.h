// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>

#include "core/lazy_array.h"
#include "index/side_table.h"
#include "tree/tree.h"

namespace umbrix::detail {

/// A child of a wide node: a leaf's run of blocks, or another wide node, made or not yet.
class WideChild {
 public:
  explicit WideChild(std::uint64_t bits = 0) noexcept : bits_(bits) {}
  static WideChild leaf(BlockRun run) noexcept { return WideChild((std::uint64_t{run.count} << 32) | run.first); }
  static WideChild made(std::uint32_t wide_node) noexcept { return WideChild(wide_node); }
  static WideChild unmade(std::uint32_t node) noexcept { return WideChild((kUnmade << 32) | node); }

  std::uint64_t bits() const noexcept { return bits_; }
  bool is_leaf() const noexcept { return bits_ >> 32 != 0 && !is_unmade(); }
  bool is_unmade() const noexcept { return bits_ >> 32 == kUnmade; }
  std::uint32_t index() const noexcept { return static_cast<std::uint32_t>(bits_); }
  BlockRun run() const noexcept { return {index(), static_cast<std::uint32_t>(bits_ >> 32)}; }

 private:
  static constexpr std::uint64_t kUnmade = 0xFFFFFFFFu;
  std::uint64_t bits_;
};

/// Up to eight descendants of an inner node of the tree, and their boxes: of inner nodes the cell, of leaves the bounds
/// of what they hold of their triangles, grown by eps. Leaves that hold nothing are left out; lanes without a child
/// have a box that nothing meets.
struct alignas(64) WideNode {
  float faces[kFaces][kBlockLanes];
  std::atomic<std::uint64_t> children[kBlockLanes];
};
static_assert(sizeof(WideNode) == 256);

/// The tree with its levels folded, so that eight boxes are tested at once and leaves are met only where they hold
/// something. Nodes are made by the first ray that comes to them, from any thread. Each is a function of the tree's
/// node alone: answers and counts do not depend on the order.
class WideTree : public SideTable {
 public:
  /// `tree` and `triangles` (the scene's, unscaled) must outlive it. Throws std::bad_alloc.
  WideTree(const Tree& tree, const Triangle* triangles);

  std::uint64_t bytes() const noexcept override;

  /// Node 0 is the root: where the tree is a leaf, with that one child.
  const WideNode& node(std::uint32_t index) const noexcept { return nodes_[index]; }

  /// The wide node behind a child that is not a leaf; made if need be.
  std::uint32_t enter(const WideNode& parent, std::uint32_t lane) const noexcept {
    const WideChild child(parent.children[lane].load(std::memory_order_acquire));
    return child.is_unmade() ? make(parent, lane) : child.index();
  }

 private:
  static constexpr std::size_t kLocks = 64;

  std::uint32_t make(const WideNode& parent, std::uint32_t lane) const noexcept;
  std::uint32_t add(std::uint32_t node, const Box& cell) const noexcept;
  Box contents(const Node& leaf, const Box& cell) const noexcept;

  const Tree& tree_;
  const Triangle* triangles_;
  LazyArray<WideNode> nodes_;
  mutable std::atomic<std::uint32_t> next_{0};
  mutable std::mutex locks_[kLocks];  ///< by parent: each node is made once
};

}  // namespace umbrix::detail
