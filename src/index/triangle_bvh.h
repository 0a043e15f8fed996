// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/lazy_array.h"
#include "core/math.h"
#include "umbrix/executor.h"

namespace umbrix::detail {

/// How many triangles stand side by side.
inline constexpr std::uint32_t kRowLanes = 16;
/// Children of a node.
inline constexpr std::uint32_t kBvhWidth = 4;

/// The exact vertices of up to sixteen triangles, in the tree's units. Lanes from `count` on repeat the first.
struct alignas(64) TriangleRows {
  float v[3][3][kRowLanes];  ///< by vertex and axis
  std::uint32_t id[kRowLanes];
  std::uint32_t count;
  float edge_bound;  ///< no edge from a first vertex is longer
  float reach;       ///< the box's diagonal: first vertices are that near to any point of the box

  // What only some walks want comes last.
  alignas(64) float normal[3][kRowLanes];  ///< of length 1, each coordinate within one unit in the last place; 0 if
                                           ///< not known
  float longest[kRowLanes];                ///< edge, or a little more
};

/// Boxes of up to four children, grown by the tree's eps as its cells are. What is left over has a box that nothing
/// meets.
struct alignas(64) BvhNode {
  float lower[3][kBvhWidth], upper[3][kBvhWidth];
  std::uint32_t child[kBvhWidth];  ///< a node, or kBvhLeaf with the place of a TriangleRows

  static constexpr std::uint32_t kLeaf = 0x80000000u;
};

/// No leaf is deeper, counted in nodes.
inline constexpr std::uint32_t kMaxBvhDepth = 64;

/// A hierarchy of boxes in which each triangle is once: for walks that many rays share, where a triangle that is met
/// twice costs more than boxes that overlap; and for all rays as long as there is no tree, since it is soon built.
class TriangleBvh {
 public:
  static constexpr std::uint32_t kWidth = kBvhWidth;

  TriangleBvh() = default;
  /// Over the triangles named by `kept`, times 2^exponent, with boxes grown by `eps`, or if that
  /// is 0 exact ones. Throws std::bad_alloc, or what
  /// the executor throws (null: oneTBB).
  TriangleBvh(const Triangle* triangles, const std::uint32_t* kept, std::size_t kept_count, int exponent, float eps,
              const Executor* executor);

  std::uint64_t bytes() const noexcept;

  /// Node 0 is the root; there is none if there are no triangles.
  bool empty() const noexcept { return nodes_.size() == 0; }
  std::size_t node_count() const noexcept { return nodes_.size(); }
  const BvhNode& node(std::uint32_t index) const noexcept { return nodes_[index]; }
  const TriangleRows& rows(std::uint32_t index) const noexcept { return rows_[index]; }

 private:
  LazyArray<BvhNode> nodes_;
  LazyArray<TriangleRows> rows_;
};

}  // namespace umbrix::detail
