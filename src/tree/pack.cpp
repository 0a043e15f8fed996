// SPDX-License-Identifier: Apache-2.0
#include "tree/pack.h"

#include <cmath>

#include "core/parallel_for.h"
#include "tree/block.h"

namespace umbrix::detail {
namespace {

/// A leaf on its way to blocks.
struct Leaf {
  std::uint32_t node;
  std::uint32_t first_block;
  float diagonal;
};

struct Visit {
  std::uint32_t node;
  Box cell;
};

}  // namespace

void pack_leaves(UnpackedTree unpacked, const std::vector<Triangle>& scaled, const CostModel& cost,
                 const Executor* executor, Tree& tree, BuildStats& stats) {
  // Walk all cells to find each leaf's diagonal and the expected cost of a random line.
  std::vector<Leaf> leaves;
  std::uint32_t block_count = 0;
  const double root_area = half_area(tree.root);
  std::vector<Visit> open{{0, tree.root}};
  while (!open.empty()) {
    const Visit visit = open.back();
    open.pop_back();
    const Node& node = unpacked.nodes[visit.node];
    const double probability = half_area(visit.cell) / root_area;
    ++stats.nodes;
    if (!node.is_leaf()) {
      stats.sah_cost += probability;
      const int axis = static_cast<int>(node.axis_bits());
      Box low = visit.cell, high = visit.cell;
      low.upper[axis] = node.plane();
      high.lower[axis] = node.plane();
      open.push_back({node.low_child() + 1, high});
      open.push_back({node.low_child(), low});
      continue;
    }
    const std::uint32_t count = node.block_count();
    stats.sah_cost += probability * cost.leaf(count);
    ++stats.leaves;
    stats.empty_leaves += count == 0;
    stats.references += count;
    stats.largest_leaf = std::max<std::uint64_t>(stats.largest_leaf, count);
    const double diagonal = glm::length(DVec3(visit.cell.extent())) + 8.0 * static_cast<double>(tree.eps);
    leaves.push_back({visit.node, block_count, static_cast<float>(diagonal)});
    block_count += (count + kBlockLanes - 1) / kBlockLanes;
  }
  stats.depth = unpacked.depth;

  // Fill the blocks.
  tree.nodes = std::move(unpacked.nodes);
  tree.blocks.resize(block_count);
  const auto triangle_of = [&scaled](std::uint32_t id) -> const Triangle& { return scaled[id]; };
  constexpr std::size_t kLeavesPerTask = 4096;
  parallel_for(executor, (leaves.size() + kLeavesPerTask - 1) / kLeavesPerTask, [&](std::size_t task) {
    const std::size_t end = std::min(leaves.size(), (task + 1) * kLeavesPerTask);
    for (std::size_t i = task * kLeavesPerTask; i < end; ++i) {
      const Leaf& leaf = leaves[i];
      Node& node = tree.nodes[leaf.node];
      const std::uint32_t first = node.first_block(), count = node.block_count();
      std::uint32_t blocks = 0;
      for (std::uint32_t done = 0; done < count; done += kBlockLanes)
        pack_block(&unpacked.references[first + done], std::min(kBlockLanes, count - done), triangle_of, leaf.diagonal,
                   tree.blocks[leaf.first_block + blocks++]);
      node = Node::leaf(leaf.first_block, blocks);
    }
  });
}

}  // namespace umbrix::detail
