// SPDX-License-Identifier: Apache-2.0
// A line that crosses a cell crosses a child with the probability of their areas' ratio (MacDonald & Booth 1990).
#include "index/subtree_costs.h"

#include <algorithm>

#include "index/cells.h"
#include "tree/split.h"

namespace umbrix::detail {
namespace {

class CostPass {
 public:
  explicit CostPass(const Tree& tree) : tree_(tree) {
    costs_.expected.resize(tree.nodes.size());
    costs_.local.resize(tree.nodes.size());
    costs_.inner_nodes.resize(tree.nodes.size());
    visit(0, tree.root, 0);
  }

  SubtreeCosts take() { return std::move(costs_); }

 private:
  /// Returns the number of references below.
  std::uint64_t visit(std::uint32_t index, const Box& cell, std::uint32_t depth) {
    const Node& node = tree_.nodes[index];
    const CostModel model;
    if (node.is_leaf()) {
      std::uint64_t count = 0;
      for (std::uint32_t b = 0; b < node.block_count(); ++b) count += tree_.blocks[node.first_block() + b].count;
      costs_.expected[index] = costs_.local[index] = static_cast<float>(model.leaf(count));
      costs_.depth = std::max(costs_.depth, depth);
      return count;
    }
    double expected = 1, local = 1;
    std::uint64_t references = 0;
    costs_.inner_nodes[index] = 1;
    for (const bool high : {false, true}) {
      const std::uint32_t child = node.low_child() + (high ? 1 : 0);
      const Box half = half_cell(cell, node, high);
      const std::uint64_t count = visit(child, half, depth + 1);
      const double probability = half_area(half) / half_area(cell);
      expected += probability * static_cast<double>(costs_.expected[child]);
      local += probability * model.leaf(count);
      references += count;
      costs_.inner_nodes[index] += costs_.inner_nodes[child];
    }
    costs_.expected[index] = static_cast<float>(expected);
    costs_.local[index] = static_cast<float>(local);
    return references;
  }

  const Tree& tree_;
  SubtreeCosts costs_;
};

}  // namespace

SubtreeCosts subtree_costs(const Tree& tree) { return CostPass(tree).take(); }

}  // namespace umbrix::detail
