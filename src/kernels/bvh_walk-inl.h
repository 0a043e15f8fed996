// SPDX-License-Identifier: Apache-2.0
// One ray through the hierarchy of boxes, four at a time, near ones first. A box is grown by eps, which covers the
// rounding of its planes' times as it does for cells (walk-inl.h): a hit lies within the float interval of every box
// above its triangle.

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

/// A ray's float times at boxes.
class BoxTimes {
 public:
  using Time = float;

  BoxTimes(const WalkRay& ray, Interval at) : ray_(ray), at_(at) {}

  float start() const { return at_.t0; }

  HWY_INLINE void cross(const BvhNode& node, CrossedBoxes<float, kBvhWidth>& out) const {
    const Lanes4 f;
    out.lanes = 0;
    for (std::uint32_t i = 0; i < kBvhWidth; i += static_cast<std::uint32_t>(hn::Lanes(f))) {
      auto t0 = hn::Set(f, at_.t0), t1 = hn::Set(f, at_.t1);
      for (std::uint32_t axis = 0; axis < 3; ++axis) {
        const bool down = ray_.far_low[axis] != 0;
        const auto origin = hn::Set(f, ray_.origin[axis]), inverse = hn::Set(f, ray_.inverse[axis]);
        const auto entry = hn::Load(f, (down ? node.upper : node.lower)[axis] + i);
        const auto exit = hn::Load(f, (down ? node.lower : node.upper)[axis] + i);
        t0 = hn::Max(t0, hn::Mul(hn::Sub(entry, origin), inverse));
        t1 = hn::Min(t1, hn::Mul(hn::Sub(exit, origin), inverse));
      }
      alignas(8) std::uint8_t bits[8] = {};
      hn::StoreMaskBits(f, hn::Le(t0, t1), bits);
      out.lanes |= static_cast<std::uint32_t>(bits[0]) << i;
      hn::Store(t0, f, out.t0 + i);
    }
  }

 private:
  const WalkRay& ray_;
  Interval at_;
};

/// Visits the rows that the ray may meet: rows(triangles, t0) returns true to stop. What starts beyond `limit` is left
/// out; it is read anew for each. `times` tells of a node which boxes the ray crosses, as BoxTimes does.
template <class Times, class Rows, class Counts>
HWY_INLINE bool bvh_walk(const TriangleBvh& bvh, const Times& times, const typename Times::Time& limit, Rows&& rows,
                         Counts& counts) {
  struct Pending {
    std::uint32_t child;
    typename Times::Time t0;
  };
  Pending stack[(kBvhWidth - 1) * kMaxBvhDepth + 1];
  std::uint32_t pending = 0;
  Pending here{0, times.start()};
  for (;;) {
    counts.node();
    if ((here.child & BvhNode::kLeaf) != 0) {
      counts.leaf();
      if (rows(bvh.rows(here.child & ~BvhNode::kLeaf), here.t0)) return true;
    } else {
      const BvhNode& node = bvh.node(here.child);
      CrossedBoxes<typename Times::Time, kBvhWidth> crossed;
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

/// A kernel of its own, and what others do while there is no tree.
struct BvhKernel {
  using State = NoState;

  template <class Counts>
  static HWY_INLINE bool occluded(const SceneView& scene, const Filter& filter, const Ray& ray, State&,
                                  Counts& counts) {
    if (HWY_UNLIKELY(!is_valid(ray))) {
      counts.invalid_ray();
      return false;
    }
    WalkRay walk_ray;
    if (HWY_UNLIKELY(prepare(ray, *scene.tree, walk_ray) == Reach::far))
      return far_occluded(scene, filter, ray, counts);
    const Interval at = clip_to_root(walk_ray, *scene.tree);
    if (!(at.t0 <= at.t1)) return false;
    const RowTest test(walk_ray);
    const auto rows = [&](const TriangleRows& triangles, float t0) {
      return block_blocks(scene, filter, ray, test, walk_ray, triangles, test.reach(triangles, t0), counts);
    };
    return bvh_walk(*scene.bvh, BoxTimes(walk_ray, at), walk_ray.tmax, rows, counts);
  }

  template <class Counts>
  static HWY_INLINE void closest(const SceneView& scene, const Filter& filter, const Ray& ray, State&, Nearest& nearest,
                                 Counts& counts) {
    if (HWY_UNLIKELY(!is_valid(ray))) {
      counts.invalid_ray();
      return;
    }
    WalkRay walk_ray;
    if (HWY_UNLIKELY(prepare(ray, *scene.tree, walk_ray) == Reach::far)) {
      far_closest(scene, filter, ray, nearest, counts);
      return;
    }
    const Interval at = clip_to_root(walk_ray, *scene.tree);
    if (!(at.t0 <= at.t1)) return;
    const RowTest test(walk_ray);
    float limit = walk_ray.tmax;
    const auto rows = [&](const TriangleRows& triangles, float t0) {
      block_closest(scene, filter, ray, test, walk_ray, triangles, test.reach(triangles, t0), nearest, limit, counts);
      return false;
    };
    bvh_walk(*scene.bvh, BoxTimes(walk_ray, at), limit, rows, counts);
  }

 private:
  // Rays that float cannot place, as in far_ray.h.
  template <class Counts>
  static bool far_occluded(const SceneView& scene, const Filter& filter, const Ray& ray, Counts& counts) {
    const DefaultFloatMode mode;
    const auto visit = [&](std::uint32_t id) { return blocks(scene, filter, ray, id, counts); };
    return FarRay(scene, ray).visit_candidates(*scene.bvh, visit, counts);
  }

  template <class Counts>
  static void far_closest(const SceneView& scene, const Filter& filter, const Ray& ray, Nearest& nearest,
                          Counts& counts) {
    const DefaultFloatMode mode;
    const auto visit = [&](std::uint32_t id) {
      nearest.offer(scene, filter, ray, id, counts);
      return false;
    };
    FarRay(scene, ray).visit_candidates(*scene.bvh, visit, counts);
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
