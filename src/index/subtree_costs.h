// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "tree/tree.h"

namespace umbrix::detail {

/// What the surface area heuristic says of the subtree below each node, by node.
struct SubtreeCosts {
  std::vector<float> expected;             ///< of a line that crosses the cell, in node steps: all of its walk below
  std::vector<float> local;                ///< the same if the children were leaves
  std::vector<std::uint32_t> inner_nodes;  ///< itself included
  std::uint32_t depth = 0;                 ///< inner nodes above the deepest leaf
};

SubtreeCosts subtree_costs(const Tree& tree);

}  // namespace umbrix::detail
