// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "index/side_table.h"
#include "tree/tree.h"

namespace umbrix::detail {

/// A triangle that every ray which enters an inner node is tested against.
struct Placement {
  std::uint32_t node, triangle;
};

/// Lists of triangles on inner nodes of the tree ("multi-index tree", Liang & Huang 2019): those that end many of the
/// rays that enter the node, wherever they are. A list is one block, so that testing it costs about one test. Which
/// node has one is a bit by node, and a list's place the number of bits before it; the nodes stay as they are.
class PrimitiveIndex : public SideTable {
 public:
  /// Placements in any order, at most kBlockLanes a node; later ones are left out. `triangles` are the scene's,
  /// unscaled. Holds on to neither. Throws std::bad_alloc.
  PrimitiveIndex(const Tree& tree, const Triangle* triangles, std::vector<Placement> placements);

  std::uint64_t bytes() const noexcept override;
  bool empty() const noexcept { return blocks_.empty(); }

  /// Which nodes have a list, a bit each; null if none has.
  class NodeBits {
   public:
    explicit NodeBits(const std::uint64_t* words) noexcept : words_(words) {}
    bool operator[](std::uint32_t node) const noexcept { return (words_[node / kBits] >> (node % kBits) & 1u) != 0; }

   private:
    const std::uint64_t* words_;
  };
  NodeBits has_list() const noexcept { return NodeBits(bits_.data()); }

  /// The node's list, if it has one. `reach` bounds the way from anywhere in the node's cell to the first vertices.
  const Block& list(std::uint32_t node) const noexcept {
    const std::uint64_t before = bits_[node / kBits] & ((std::uint64_t{1} << (node % kBits)) - 1);
    return blocks_[lists_before_[node / kBits] + static_cast<std::uint32_t>(__builtin_popcountll(before))];
  }

  /// Is the block one of the lists?
  bool holds(const Block* block) const noexcept {
    return !std::less<>()(block, blocks_.data()) && std::less<>()(block, blocks_.data() + blocks_.size());
  }

  /// All lists, and the nodes they belong to, in ascending order.
  const std::vector<Block>& lists() const noexcept { return blocks_; }
  const std::vector<std::uint32_t>& nodes() const noexcept { return nodes_; }

 private:
  static constexpr std::uint32_t kBits = 64;

  std::vector<std::uint64_t> bits_;          ///< by node; none if there are no lists
  std::vector<std::uint32_t> lists_before_;  ///< by word of bits
  std::vector<std::uint32_t> nodes_;
  std::vector<Block> blocks_;
};

}  // namespace umbrix::detail
