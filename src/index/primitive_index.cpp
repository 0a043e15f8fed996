// SPDX-License-Identifier: Apache-2.0
#include "index/primitive_index.h"

#include <algorithm>
#include <glm/common.hpp>

#include "core/float_mode.h"
#include "index/cells.h"
#include "tree/block.h"
#include "tree/scale.h"

namespace umbrix::detail {
namespace {

/// How far a point of the cell can be from `from`.
double farthest(const Box& cell, const Vec3& from) {
  const DVec3 low = glm::abs(DVec3(cell.lower) - DVec3(from)), high = glm::abs(DVec3(cell.upper) - DVec3(from));
  return glm::length(glm::max(low, high));
}

/// The list is tested against the whole ray, so its triangles need not meet the cell: hence a reach of its own.
void pack_list(const Tree& tree, const Triangle* triangles, std::uint32_t node, const std::uint32_t* ids,
               std::uint32_t count, Block& block) {
  const auto triangle_of = [&](std::uint32_t id) { return scaled(triangles[id], tree.scale_exponent); };
  pack_block(ids, count, triangle_of, 0, block);
  const Box cell = cell_of(tree, node, tree.root);
  double reach = 0;
  for (std::uint32_t i = 0; i < count; ++i) reach = std::max(reach, farthest(cell, triangle_of(ids[i]).v[0]));
  block.reach = bound(reach + 8.0 * static_cast<double>(tree.eps));
}

}  // namespace

PrimitiveIndex::PrimitiveIndex(const Tree& tree, const Triangle* triangles, std::vector<Placement> placements) {
  if (placements.empty()) return;
  const DefaultFloatMode mode;
  std::stable_sort(placements.begin(), placements.end(),
                   [](const Placement& a, const Placement& b) { return a.node < b.node; });
  bits_.resize(tree.nodes.size() / kBits + 1);
  for (std::size_t first = 0, end = 0; first < placements.size(); first = end) {
    const std::uint32_t node = placements[first].node;
    std::uint32_t ids[kBlockLanes], count = 0;
    for (end = first; end < placements.size() && placements[end].node == node; ++end)
      if (count < kBlockLanes) ids[count++] = placements[end].triangle;
    nodes_.push_back(node);
    bits_[node / kBits] |= std::uint64_t{1} << (node % kBits);
    pack_list(tree, triangles, node, ids, count, blocks_.emplace_back());
  }
  std::uint32_t lists = 0;
  for (const std::uint64_t word : bits_) {
    lists_before_.push_back(lists);
    lists += static_cast<std::uint32_t>(__builtin_popcountll(word));
  }
}

std::uint64_t PrimitiveIndex::bytes() const noexcept {
  return bits_.size() * (sizeof(bits_[0]) + sizeof(lists_before_[0])) + nodes_.size() * sizeof(nodes_[0]) +
         blocks_.size() * sizeof(Block);
}

}  // namespace umbrix::detail
