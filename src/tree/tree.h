// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "core/math.h"

namespace umbrix::detail {

inline constexpr std::uint32_t kBlockLanes = 8;
inline constexpr std::uint32_t kMaxDepth = 60;

/// The low sides of a cell along x, y, z, then the high ones.
inline constexpr std::uint32_t kFaces = 6;
constexpr std::uint32_t face_of(std::uint32_t axis, bool high) noexcept { return axis + (high ? 3u : 0u); }

/// Blocks that stand side by side.
struct BlockRun {
  std::uint32_t first, count;
};

/// An inner node splits its cell by an axis-aligned plane into two children that lie side by side, the one on the low
/// side at an even index. A leaf names a run of triangle blocks. One bit is kept for the multi-index layer.
class Node {
 public:
  static Node inner(int axis, float plane, std::uint32_t low_child) noexcept {
    Node node;
    node.plane_ = plane;
    node.bits_ = (low_child << 3) | static_cast<std::uint32_t>(axis);
    return node;
  }
  static Node leaf(std::uint32_t first_block, std::uint32_t block_count) noexcept {
    Node node;
    std::memcpy(&node.plane_, &first_block, sizeof first_block);
    node.bits_ = (block_count << 3) | kLeaf;
    return node;
  }

  std::uint32_t axis_bits() const noexcept { return bits_ & 3u; }
  bool is_leaf() const noexcept { return axis_bits() == kLeaf; }
  float plane() const noexcept { return plane_; }
  std::uint32_t low_child() const noexcept { return bits_ >> 3; }
  std::uint32_t block_count() const noexcept { return bits_ >> 3; }
  std::uint32_t first_block() const noexcept {
    std::uint32_t first;
    std::memcpy(&first, &plane_, sizeof first);
    return first;
  }

  BlockRun blocks() const noexcept { return {first_block(), block_count()}; }

 private:
  static constexpr std::uint32_t kLeaf = 3;
  float plane_ = 0;
  std::uint32_t bits_ = kLeaf;
};
static_assert(sizeof(Node) == 8);

/// Up to eight triangles of one leaf, a row for each coordinate: a vertex and the two edges from it, rounded to float.
/// The slow tests fetch the exact vertices by id. Lanes from `count` on repeat the first triangle.
struct alignas(32) Block {
  float edge_bound;  ///< no |e1| or |e2| is longer
  float reach;  ///< edge_bound plus the diagonal of the leaf's cell: vertex 0 is that near to any point of the cell
  std::uint32_t count;  ///< lanes in use
  alignas(32) float v0[3][kBlockLanes];
  float e1[3][kBlockLanes];
  float e2[3][kBlockLanes];
  std::uint32_t id[kBlockLanes];
};

/// A box as vectors want it: x, y, z and a lane without bounds.
struct BoxLanes {
  alignas(16) float lower[4] = {};
  alignas(16) float upper[4] = {};

  BoxLanes() = default;
  explicit BoxLanes(const Box& box)
      : lower{box.lower.x, box.lower.y, box.lower.z, -std::numeric_limits<float>::infinity()},
        upper{box.upper.x, box.upper.y, box.upper.z, std::numeric_limits<float>::infinity()} {}
};

/// A KD-tree over triangles scaled by 2^scale_exponent so that the largest coordinate is in [0.5, 1): all plane times
/// and filter bounds then stay in range for scenes of any size. Children tile their parent; a triangle is referenced by
/// every leaf whose cell, grown by `eps`, it meets.
struct Tree {
  std::vector<Node> nodes;  ///< root first, then pairs of siblings from index 2
  std::vector<Block> blocks;
  Box root;  ///< bounds of the scaled triangles, grown by eps
  BoxLanes root_lanes{Box()};
  float eps = 0;
  int scale_exponent = 0;
};

}  // namespace umbrix::detail
