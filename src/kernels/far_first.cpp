// SPDX-License-Identifier: Apache-2.0
// The far child first, always: where blockers stand near the light rather than near the surface, this finds them
// sooner.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/far_first.cpp"

#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

#include "kernels/ordered_walk-inl.h"
#include "kernels/tree_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {
namespace {

struct FarFirstWalk {
  using State = NoState;
  static constexpr bool kNearFirst = false;

  template <class Leaf, class Counts>
  static HWY_INLINE bool walk(const SceneView& scene, State&, const WalkRay& ray, const float&, Leaf&& leaf,
                              Counts& counts) {
    const Interval at = clip_to_root(ray, *scene.tree);
    const auto far_child = [](std::uint32_t, std::uint32_t near) { return near ^ 1u; };
    return at.t0 <= at.t1 && ordered_walk(*scene.tree, at, ray, far_child, leaf, counts);
  }
};

const EntryPoints& far_first() { return entry_points<TreeKernel<FarFirstWalk>>(); }

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
UMBRIX_DEFINE_KERNEL(kFarFirstKernel, far_first, "far-first", "stack walk from the root, far child first", nullptr)
#endif
