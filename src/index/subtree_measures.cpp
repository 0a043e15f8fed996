// SPDX-License-Identifier: Apache-2.0
#include "index/subtree_measures.h"

#include <algorithm>
#include <functional>

#include "core/parallel_for.h"
#include "index/parents.h"
#include "tree/clip.h"

namespace umbrix::detail {
namespace {

/// A block's triangle, from its rounded edges.
Triangle triangle_in(const Block& block, std::uint32_t lane) {
  Triangle t;
  for (int axis = 0; axis < 3; ++axis) {
    t.v[0][axis] = block.v0[axis][lane];
    t.v[1][axis] = block.v0[axis][lane] + block.e1[axis][lane];
    t.v[2][axis] = block.v0[axis][lane] + block.e2[axis][lane];
  }
  return t;
}

/// Calls visit(block, lane) for each reference of a leaf.
template <class Visit>
void for_each_reference(const Tree& tree, const Node& leaf, Visit&& visit) {
  for (std::uint32_t b = 0; b < leaf.block_count(); ++b) {
    const Block& block = tree.blocks[leaf.first_block() + b];
    for (std::uint32_t lane = 0; lane < block.count; ++lane) visit(block, lane);
  }
}

/// Calls visit(node) for each leaf, in parallel.
void for_each_leaf(const Tree& tree, const Executor* executor, const std::function<void(std::uint32_t)>& visit) {
  constexpr std::size_t kNodesPerTask = 4096;
  const std::size_t count = tree.nodes.size();
  parallel_for(executor, (count + kNodesPerTask - 1) / kNodesPerTask, [&](std::size_t task) {
    const std::size_t end = std::min(count, (task + 1) * kNodesPerTask);
    for (std::size_t i = task * kNodesPerTask; i < end; ++i)
      if (tree.nodes[i].is_leaf()) visit(static_cast<std::uint32_t>(i));
  });
}

/// Calls visit(node, low child) for the inner nodes, children before parents.
template <class Visit>
void for_each_inner_upwards(const Tree& tree, Visit&& visit) {
  for (auto i = static_cast<std::uint32_t>(tree.nodes.size()); i-- > 0;)
    if (!tree.nodes[i].is_leaf()) visit(i, tree.nodes[i].low_child());
}

void sum_upwards(const Tree& tree, std::vector<double>& values) {
  for_each_inner_upwards(tree,
                         [&](std::uint32_t node, std::uint32_t low) { values[node] += values[low] + values[low + 1]; });
}

/// The leaves from the low end to the high one, so that those below any node stand together.
std::vector<std::uint32_t> leaves_in_order(const Tree& tree) {
  std::vector<std::uint32_t> leaves, open{0};
  while (!open.empty()) {
    const std::uint32_t at = open.back();
    const Node& node = tree.nodes[at];
    open.pop_back();
    if (node.is_leaf()) {
      leaves.push_back(at);
    } else {
      open.push_back(node.low_child() + 1);
      open.push_back(node.low_child());
    }
  }
  return leaves;
}

}  // namespace

std::vector<Box> cells_of(const Tree& tree) {
  std::vector<Box> cells(tree.nodes.size());
  cells[0] = tree.root;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Node& node = tree.nodes[i];
    if (node.is_leaf()) continue;
    const int axis = static_cast<int>(node.axis_bits());
    Box& low = cells[node.low_child()] = cells[i];
    Box& high = cells[node.low_child() + 1] = cells[i];
    low.upper[axis] = high.lower[axis] = node.plane();
  }
  return cells;
}

std::vector<double> cell_areas(const Tree& tree) {
  const std::vector<Box> cells = cells_of(tree);
  std::vector<double> areas(cells.size());
  std::transform(cells.begin(), cells.end(), areas.begin(), half_area);
  return areas;
}

std::vector<double> tight_box_areas(const Tree& tree, const Executor* executor) {
  const std::vector<Box> cells = cells_of(tree);
  std::vector<Box> boxes(cells.size());
  for_each_leaf(tree, executor, [&](std::uint32_t leaf) {
    for_each_reference(tree, tree.nodes[leaf], [&](const Block& block, std::uint32_t lane) {
      boxes[leaf].extend(clipped_bounds(triangle_in(block, lane), cells[leaf], 0));
    });
  });
  for_each_inner_upwards(tree, [&](std::uint32_t node, std::uint32_t low) {
    boxes[node].extend(boxes[low]);
    boxes[node].extend(boxes[low + 1]);
  });
  std::vector<double> areas(boxes.size());
  std::transform(boxes.begin(), boxes.end(), areas.begin(),
                 [](const Box& box) { return box.empty() ? 0 : half_area(box); });
  return areas;
}

std::vector<double> triangle_areas(const Tree& tree, const Executor* executor) {
  const std::vector<Box> cells = cells_of(tree);
  std::vector<double> areas(cells.size());
  for_each_leaf(tree, executor, [&](std::uint32_t leaf) {
    for_each_reference(tree, tree.nodes[leaf], [&](const Block& block, std::uint32_t lane) {
      areas[leaf] += clipped_area(triangle_in(block, lane), cells[leaf]);
    });
  });
  sum_upwards(tree, areas);
  return areas;
}

std::vector<double> leaf_visibilities(const Tree& tree, const Executor* executor) {
  const std::vector<Box> cells = cells_of(tree);
  std::vector<double> visibilities(cells.size(), 1);
  for_each_leaf(tree, executor, [&](std::uint32_t leaf) {
    // A flat patch stops a line through its convex cell with probability 2 area / SA(cell) (Cauchy & Crofton).
    const double half_cell_area = half_area(cells[leaf]);
    for_each_reference(tree, tree.nodes[leaf], [&](const Block& block, std::uint32_t lane) {
      visibilities[leaf] *= 1 - std::min(1.0, clipped_area(triangle_in(block, lane), cells[leaf]) / half_cell_area);
    });
  });
  return visibilities;
}

std::vector<double> triangle_counts(const Tree& tree) {
  // With leaves in order, a triangle named by two of them in succession is counted twice in their lowest common
  // ancestor and above: take one off there.
  const std::vector<std::uint32_t> parents = parents_of_pairs(tree);
  std::vector<double> counts(tree.nodes.size());
  std::vector<std::uint32_t> last_leaf;
  for (const std::uint32_t leaf : leaves_in_order(tree)) {
    for_each_reference(tree, tree.nodes[leaf], [&](const Block& block, std::uint32_t lane) {
      const std::uint32_t id = block.id[lane];
      if (id >= last_leaf.size()) last_leaf.resize(id + 1);
      counts[leaf] += 1;
      if (last_leaf[id] != 0) {
        std::uint32_t a = last_leaf[id], b = leaf;
        while (a != b) (a > b ? a : b) = parents[(a > b ? a : b) / 2];
        counts[a] -= 1;
      }
      last_leaf[id] = leaf;
    });
  }
  sum_upwards(tree, counts);
  return counts;
}

}  // namespace umbrix::detail
