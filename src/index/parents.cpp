// SPDX-License-Identifier: Apache-2.0
#include "index/parents.h"

#include <algorithm>
#include <limits>

namespace umbrix::detail {

std::vector<std::uint32_t> parents_of_pairs(const Tree& tree) {
  std::vector<std::uint32_t> parents(tree.nodes.size() / 2);
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i)
    if (!tree.nodes[i].is_leaf()) parents[tree.nodes[i].low_child() / 2] = i;
  return parents;
}

Parents::Parents(const Tree& tree) : pairs_(tree.nodes.size() / 2) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  pairs_[0] = {{-kInfinity, -kInfinity, -kInfinity, kInfinity, kInfinity, kInfinity}, 0};
  // Parents come before their children, so each finds its own cell made.
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
    const Node& node = tree.nodes[i];
    if (node.is_leaf()) continue;
    Parent& made = pairs_[node.low_child() / 2];
    made = pairs_[i / 2];
    made.node = i;
    if (i == 0) continue;
    const Node& above = tree.nodes[pairs_[i / 2].node];
    made.faces[face_of(above.axis_bits(), i % 2 == 0)] = above.plane();
  }
}

}  // namespace umbrix::detail
