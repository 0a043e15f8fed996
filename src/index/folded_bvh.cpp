// SPDX-License-Identifier: Apache-2.0
#include "index/folded_bvh.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace umbrix::detail {
namespace {

/// A child of a node of the hierarchy.
struct Descendant {
  float lower[3], upper[3];
  std::uint32_t child;

  Descendant(const BvhNode& node, std::uint32_t lane) : child(node.child[lane]) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      lower[k] = node.lower[k][lane];
      upper[k] = node.upper[k][lane];
    }
  }

  bool is_leaf() const { return (child & BvhNode::kLeaf) != 0; }
  bool is_there() const { return lower[0] <= upper[0]; }
  /// Half of its surface.
  float area() const {
    const float x = upper[0] - lower[0], y = upper[1] - lower[1], z = upper[2] - lower[2];
    return x * y + y * z + z * x;
  }
};

void add_children(const BvhNode& node, std::vector<Descendant>& out) {
  for (std::uint32_t lane = 0; lane < kBvhWidth; ++lane) {
    const Descendant child(node, lane);
    if (child.is_there()) out.push_back(child);
  }
}

/// Up to sixteen descendants of a node.
void fold(const TriangleBvh& bvh, std::uint32_t index, std::vector<Descendant>& out) {
  out.clear();
  add_children(bvh.node(index), out);
  for (;;) {
    // A node has up to three more children than it is itself.
    auto largest = out.end();
    for (auto it = out.begin(); it != out.end(); ++it)
      if (!it->is_leaf() && (largest == out.end() || it->area() > largest->area())) largest = it;
    if (largest == out.end() || out.size() + kBvhWidth - 1 > kRowLanes) break;
    const std::uint32_t child = largest->child;
    out.erase(largest);
    add_children(bvh.node(child), out);
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const Descendant& a, const Descendant& b) { return a.area() > b.area(); });
}

}  // namespace

FoldedBvh::FoldedBvh(const TriangleBvh& bvh) : bvh_(&bvh) {
  if (bvh.empty()) return;
  nodes_ = LazyArray<FoldedNode>(bvh.node_count(), Fill::nothing);
  std::vector<std::uint32_t> of_bvh = {0};  // by folded node
  std::vector<Descendant> children;
  for (std::size_t i = 0; i < of_bvh.size(); ++i) {
    fold(bvh, of_bvh[i], children);
    FoldedNode& node = nodes_[count_++];
    for (std::uint32_t lane = 0; lane < kRowLanes; ++lane) {
      const bool is_there = lane < children.size();
      for (std::uint32_t k = 0; k < 3; ++k) {
        node.lower[k][lane] = is_there ? children[lane].lower[k] : std::numeric_limits<float>::infinity();
        node.upper[k][lane] = is_there ? children[lane].upper[k] : -std::numeric_limits<float>::infinity();
      }
      node.child[lane] = 0;
      if (!is_there) continue;
      node.child[lane] = children[lane].child;
      if (children[lane].is_leaf()) continue;
      node.child[lane] = static_cast<std::uint32_t>(of_bvh.size());
      of_bvh.push_back(children[lane].child);
    }
  }
}

}  // namespace umbrix::detail
