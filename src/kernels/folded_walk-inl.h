// SPDX-License-Identifier: Apache-2.0
// One ray through the folded hierarchy, sixteen boxes at a time. Boxes and their times are those of bvh_walk-inl.h.

#if defined(UMBRIX_KERNELS_FOLDED_WALK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_FOLDED_WALK_INL_H_
#undef UMBRIX_KERNELS_FOLDED_WALK_INL_H_
#else
#define UMBRIX_KERNELS_FOLDED_WALK_INL_H_
#endif

#include <hwy/highway.h>

#include "index/folded_bvh.h"
#include "kernels/bvh_walk-inl.h"
#include "kernels/ray_lanes-inl.h"
#include "kernels/tree_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

/// Sixteen boxes against one ray.
class FoldedTimes {
 public:
  using Time = float;

  FoldedTimes(const WalkRay& ray, Interval at) {
    const RayTag f;
    for (std::uint32_t k = 0; k < 3; ++k) {
      origin_[k] = hn::Set(f, ray.origin[k]);
      inverse_[k] = hn::Set(f, ray.inverse[k]);
      // lower and upper lie side by side
      entry_[k] = (ray.far_low[k] != 0 ? 3 + k : k) * kRowLanes;
      exit_[k] = (ray.far_low[k] != 0 ? k : 3 + k) * kRowLanes;
    }
    t0_ = hn::Set(f, at.t0);
    t1_ = hn::Set(f, at.t1);
  }

  float start() const { return hn::GetLane(t0_); }

  HWY_INLINE void cross(const FoldedNode& node, CrossedBoxes<float, kRowLanes>& out) const {
    const RayTag f;
    const float* const faces = &node.lower[0][0];
    out.lanes = 0;
    for (std::uint32_t i = 0; i < kRowLanes; i += static_cast<std::uint32_t>(hn::Lanes(f))) {
      auto t0 = t0_, t1 = t1_;
      for (std::uint32_t k = 0; k < 3; ++k) {
        t0 = hn::Max(t0, hn::Mul(hn::Sub(hn::Load(f, faces + entry_[k] + i), origin_[k]), inverse_[k]));
        t1 = hn::Min(t1, hn::Mul(hn::Sub(hn::Load(f, faces + exit_[k] + i), origin_[k]), inverse_[k]));
      }
      out.lanes |= ray_bits(hn::Le(t0, t1)) << i;
      hn::Store(t0, f, out.t0 + i);
    }
  }

 private:
  RayVec origin_[3], inverse_[3], t0_, t1_;
  std::size_t entry_[3], exit_[3];
};

/// For any hit: visits the rows that the ray may meet, those of a node at once, then its children as they come, the
/// largest first. rows(triangles, t0) returns true to stop. (For the nearest hit: bvh_walk.)
template <class Rows, class Counts>
HWY_INLINE bool any_walk(const FoldedBvh& bvh, const FoldedTimes& times, Rows&& rows, Counts& counts) {
  std::uint32_t stack[(kRowLanes - 1) * kMaxBvhDepth + 1];
  std::uint32_t pending = 0, here = 0;
  for (;;) {
    counts.node();
    const FoldedNode& node = bvh.node(here);
    CrossedBoxes<float, kRowLanes> crossed;
    times.cross(node, crossed);
    std::uint32_t inner[kRowLanes], inner_count = 0;
    for (std::uint32_t rest = crossed.lanes; rest != 0; rest &= rest - 1) {
      const std::uint32_t lane = lane_of(rest), child = node.child[lane];
      if ((child & BvhNode::kLeaf) == 0) {
        inner[inner_count++] = child;
        continue;
      }
      counts.node();
      counts.leaf();
      if (rows(bvh.rows(child & ~BvhNode::kLeaf), crossed.t0[lane])) return true;
    }
    while (inner_count > 0) stack[pending++] = inner[--inner_count];
    if (pending == 0) return false;
    here = stack[--pending];
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
