// SPDX-License-Identifier: Apache-2.0
// The farthest vertex along an axis by branch and bound.
#include "index/placed_bounds.h"

#include <algorithm>
#include <limits>

#include "core/transform.h"

namespace umbrix::detail {
namespace {

/// The largest coordinate, by one row of a transform.
class Farthest {
 public:
  Farthest(const TriangleBvh& bvh, const double (&row)[4]) : bvh_(bvh) { std::copy(row, row + 4, row_); }

  float find() {
    visit(0);
    return best_;
  }

 private:
  static constexpr float kNone = -std::numeric_limits<float>::infinity();

  /// No vertex in the box has more: rounding keeps the order of numbers, in each product and sum.
  float most(const BvhNode& node, std::uint32_t lane) const {
    if (node.lower[0][lane] > node.upper[0][lane]) return kNone;
    Vec3 corner;
    for (int axis = 0; axis < 3; ++axis) corner[axis] = (row_[axis] < 0 ? node.lower : node.upper)[axis][lane];
    return placed(row_, corner);
  }

  void visit_leaf(const TriangleRows& rows) {
    for (const auto& vertex : rows.v)
      for (std::uint32_t i = 0; i < rows.count; ++i)
        best_ = std::max(best_, placed(row_, Vec3(vertex[0][i], vertex[1][i], vertex[2][i])));
  }

  // No deeper than the hierarchy.
  void visit(std::uint32_t index) {
    const BvhNode& node = bvh_.node(index);
    float bounds[kBvhWidth];
    for (std::uint32_t lane = 0; lane < kBvhWidth; ++lane) bounds[lane] = most(node, lane);
    // The farthest first.
    for (;;) {
      const auto farthest = std::max_element(bounds, bounds + kBvhWidth);
      if (*farthest <= best_) return;
      const std::uint32_t child = node.child[farthest - bounds];
      *farthest = kNone;
      if ((child & BvhNode::kLeaf) != 0)
        visit_leaf(bvh_.rows(child & ~BvhNode::kLeaf));
      else
        visit(child);
    }
  }

  const TriangleBvh& bvh_;
  double row_[4];
  float best_ = kNone;
};

}  // namespace

Box placed_bounds(const TriangleBvh& bvh, const double (&to_world)[3][4]) noexcept {
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    const auto& row = to_world[axis];
    box.upper[axis] = Farthest(bvh, row).find();
    box.lower[axis] = -Farthest(bvh, {-row[0], -row[1], -row[2], -row[3]}).find();
  }
  return box;
}

}  // namespace umbrix::detail
