// SPDX-License-Identifier: Apache-2.0
// The stack walk with either child first. It enters the same leaves over the same intervals as the walk that goes near
// first, since only the order differs: stack entries hold both ends of their interval.

#if defined(UMBRIX_KERNELS_ORDERED_WALK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_ORDERED_WALK_INL_H_
#undef UMBRIX_KERNELS_ORDERED_WALK_INL_H_
#else
#define UMBRIX_KERNELS_ORDERED_WALK_INL_H_
#endif

#include <hwy/highway.h>

#include "kernels/walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

/// Where the interval crosses both children of a node, first_child(node, near child) goes first.
template <class FirstChild, class Leaf, class Counts>
HWY_INLINE bool ordered_walk(const Tree& tree, Interval at, const WalkRay& ray, const FirstChild& first_child,
                             Leaf&& leaf, Counts& counts) {
  struct Pending {
    std::uint32_t node;
    Interval at;
  };
  Pending stack[kMaxDepth + 1];
  std::uint32_t pending = 0, index = 0;
  const Node* const nodes = tree.nodes.data();
  for (;;) {
    Node node = nodes[index];
    counts.node();
    while (!node.is_leaf()) {
      const std::uint32_t axis = node.axis_bits();
      const float t = plane_time(ray, node.plane(), axis);
      const std::uint32_t near = node.low_child() + ray.far_low[axis];
      if (t >= at.t1) {
        index = near;
      } else if (t <= at.t0) {
        index = near ^ 1u;
      } else {
        const bool near_first = first_child(index, near) == near;
        stack[pending++] = near_first ? Pending{near ^ 1u, {t, at.t1}} : Pending{near, {at.t0, t}};
        (near_first ? at.t1 : at.t0) = t;
        index = near_first ? near : near ^ 1u;
      }
      node = nodes[index];
      counts.node();
    }
    counts.leaf();
    if (node.block_count() != 0 && leaf(node.blocks(), at.t0, at.t1)) return true;
    if (pending == 0) return false;
    --pending;
    index = stack[pending].node;
    at = stack[pending].at;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
