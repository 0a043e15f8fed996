// SPDX-License-Identifier: Apache-2.0
// Single rays in the folded hierarchy of boxes, which a scene always has.

#if defined(UMBRIX_KERNELS_BVH_KERNEL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_BVH_KERNEL_INL_H_
#undef UMBRIX_KERNELS_BVH_KERNEL_INL_H_
#else
#define UMBRIX_KERNELS_BVH_KERNEL_INL_H_
#endif

#include <hwy/highway.h>

#include "kernels/folded_walk-inl.h"
#include "kernels/tree_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

/// A kernel of its own, and what others do with rays that walk alone.
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
    return any_walk(*scene.folded, *scene.bvh, FoldedTimes(walk_ray, at), rows, counts);
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
    };
    near_walk(*scene.folded, *scene.bvh, FoldedTimes(walk_ray, at), limit, rows, counts);
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
