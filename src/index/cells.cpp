// SPDX-License-Identifier: Apache-2.0
#include "index/cells.h"

namespace umbrix::detail {
namespace {

/// Is the node in the low child's subtree? Nodes are numbered depth first, low before high.
bool is_below_low(const Tree& tree, const Node& parent, std::uint32_t node) noexcept {
  const std::uint32_t low = parent.low_child();
  if (node <= low + 1) return node == low;
  const Node& high = tree.nodes[low + 1];
  return !tree.nodes[low].is_leaf() && (high.is_leaf() || node < high.low_child());
}

}  // namespace

std::uint32_t child_towards(const Tree& tree, const Node& parent, std::uint32_t node) noexcept {
  return parent.low_child() + (is_below_low(tree, parent, node) ? 0 : 1);
}

Box cell_of(const Tree& tree, std::uint32_t node, const Box& root) noexcept {
  Box cell = root;
  for (std::uint32_t at = 0; at != node;) {
    const Node& parent = tree.nodes[at];
    at = child_towards(tree, parent, node);
    cell = half_cell(cell, parent, at != parent.low_child());
  }
  return cell;
}

bool is_within_subtree(const Tree& tree, std::uint32_t above, std::uint32_t node) noexcept {
  std::uint32_t at = 0;
  while (at != above && at != node) at = child_towards(tree, tree.nodes[at], node);
  return at == above;
}

}  // namespace umbrix::detail
