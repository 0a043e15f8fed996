// SPDX-License-Identifier: Apache-2.0
// A walk of a hierarchy of boxes, plain or folded, near ones first, for whatever can tell which boxes it crosses and
// when. A box is grown by eps, which covers the rounding of its planes' times as it does for cells (walk-inl.h): a hit
// lies within the float interval of every box above its triangle.

#if defined(UMBRIX_KERNELS_BVH_WALK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_BVH_WALK_INL_H_
#undef UMBRIX_KERNELS_BVH_WALK_INL_H_
#else
#define UMBRIX_KERNELS_BVH_WALK_INL_H_
#endif

#include <hwy/highway.h>

#include "kernels/tree_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

static_assert(kBvhWidth == 4, "boxes fill Lanes4");

/// Of boxes side by side, those that a ray crosses, and when it enters them.
template <class Time, std::uint32_t kBoxes>
struct CrossedBoxes {
  alignas(64) Time t0[kBoxes];
  std::uint32_t lanes = 0;
};

/// Visits the rows that may be met: rows(triangles, t0) returns true to stop. What starts beyond `limit` is left out;
/// it is read anew for each. times.cross(node, out) tells which of a node's boxes are crossed.
template <class Hierarchy, class Times, class Rows, class Counts>
HWY_INLINE bool bvh_walk(const Hierarchy& bvh, const Times& times, const typename Times::Time& limit, Rows&& rows,
                         Counts& counts) {
  struct Pending {
    std::uint32_t child;
    typename Times::Time t0;
  };
  Pending stack[(Hierarchy::kWidth - 1) * kMaxBvhDepth + 1];
  std::uint32_t pending = 0;
  Pending here{0, times.start()};
  for (;;) {
    counts.node();
    if ((here.child & BvhNode::kLeaf) != 0) {
      counts.leaf();
      if (rows(bvh.rows(here.child & ~BvhNode::kLeaf), here.t0)) return true;
    } else {
      const auto& node = bvh.node(here.child);
      CrossedBoxes<typename Times::Time, Hierarchy::kWidth> crossed;
      times.cross(node, crossed);
      // Onto the stack, the nearest last.
      const std::uint32_t base = pending;
      for (std::uint32_t rest = crossed.lanes; rest != 0; rest &= rest - 1) {
        const std::uint32_t lane = lane_of(rest);
        std::uint32_t place = pending++;
        for (; place > base && stack[place - 1].t0 < crossed.t0[lane]; --place) stack[place] = stack[place - 1];
        stack[place] = {node.child[lane], crossed.t0[lane]};
      }
    }
    do {
      if (pending == 0) return false;
      here = stack[--pending];
    } while (here.t0 > limit);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
