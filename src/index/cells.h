// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tree/tree.h"

namespace umbrix::detail {

/// A child's cell.
inline Box half_cell(Box cell, const Node& node, bool high) noexcept {
  const int axis = static_cast<int>(node.axis_bits());
  (high ? cell.lower : cell.upper)[axis] = node.plane();
  return cell;
}

/// The child of `parent`, whose subtree holds the node, on the way to it.
std::uint32_t child_towards(const Tree& tree, const Node& parent, std::uint32_t node) noexcept;

/// The node's cell, where the root's is `root`.
Box cell_of(const Tree& tree, std::uint32_t node, const Box& root) noexcept;

/// Is the node in the subtree below `above`, or the same?
bool is_within_subtree(const Tree& tree, std::uint32_t above, std::uint32_t node) noexcept;

}  // namespace umbrix::detail
