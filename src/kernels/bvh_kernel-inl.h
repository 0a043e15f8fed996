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

/// A kernel of its own, and what others do with rays that walk alone. What is not inlined by itself takes 1.06 of the
/// time.
struct BvhKernel {
  using State = NoState;

  template <class Counts>
  static HWY_INLINE bool occluded(const SceneView& scene, const Filter& filter, const Ray& ray, State&,
                                  Counts& counts) {
    return occluded_by(
        scene, filter, ray, counts, scene.bvh, [&](const WalkRay& walk_ray) __attribute__((always_inline)) {
          const Interval at = clip_to_root(walk_ray, *scene.tree);
          if (!(at.t0 <= at.t1)) return false;
          const RowTest test(walk_ray);
          const auto rows = [&](const TriangleRows& triangles, float t0) {
            return block_blocks(scene, filter, ray, test, walk_ray, triangles, test.reach(triangles, t0), counts);
          };
          return any_walk(*scene.folded, FoldedTimes(walk_ray, at), rows, counts);
        });
  }

  template <class Counts>
  static HWY_INLINE void closest(const SceneView& scene, const Filter& filter, const Ray& ray, State&, Nearest& nearest,
                                 Counts& counts) {
    closest_by(
        scene, filter, ray, nearest, counts, scene.bvh, [&](const WalkRay& walk_ray) __attribute__((always_inline)) {
          const Interval at = clip_to_root(walk_ray, *scene.tree);
          if (!(at.t0 <= at.t1)) return;
          const RowTest test(walk_ray);
          float limit = walk_ray.tmax;
          const auto rows = [&](const TriangleRows& triangles, float t0) {
            block_closest(scene, filter, ray, test, walk_ray, triangles, test.reach(triangles, t0), nearest, limit,
                          counts);
            return false;
          };
          bvh_walk(*scene.folded, FoldedTimes(walk_ray, at), limit, rows, counts);
        });
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
