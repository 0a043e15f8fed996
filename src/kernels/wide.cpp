// SPDX-License-Identifier: Apache-2.0
// Single rays over the tree folded to eight children a node (Wald, Benthin & Boulos 2008, "Getting rid of packets").

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/wide.cpp"

#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

#include "kernels/tree_kernel-inl.h"
#include "kernels/wide_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {
namespace {

struct WideWalk {
  struct State {
    const WideTree* tree;

    explicit State(const SceneView& scene) : tree(static_cast<const WideTree*>(scene.side)) {}
  };
  static constexpr bool kNearFirst = false;

  template <class Leaf, class Counts>
  static HWY_INLINE bool walk(const SceneView& scene, State& state, const WalkRay& ray, const float& limit, Leaf&& leaf,
                              Counts& counts) {
    const Interval at = clip_to_root(ray, scene.tree->root);
    if (!(at.t0 <= at.t1)) return false;
    if (HWY_UNLIKELY(!state.tree)) return stack_walk(*scene.tree, 0, at, ray, limit, leaf, counts);
    return wide_walk(*state.tree, at, ray, leaf, counts);
  }
};

const EntryPoints& wide() { return entry_points<TreeKernel<WideWalk>>(); }

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace umbrix::detail {
namespace {

std::unique_ptr<SideTable> make_wide_tree(const PrepareInput& input) {
  return std::make_unique<WideTree>(*input.scene.tree, input.scene.triangles);
}

}  // namespace
}  // namespace umbrix::detail
UMBRIX_DEFINE_KERNEL(kWideKernel, wide, "wide", "the tree folded to eight children a node, where rays want it",
                     make_wide_tree)
#endif
