// SPDX-License-Identifier: Apache-2.0
// The walk of the kernels that keep one bit a node: which child goes first, whatever the ray.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/ordered.cpp"

#include "kernels/ordered.h"

#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

#include "index/child_order.h"
#include "kernels/ordered_walk-inl.h"
#include "kernels/tree_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {
namespace {

struct OrderedWalk {
  struct State {
    const ChildOrder* order;

    explicit State(const SceneView& scene) : order(static_cast<const ChildOrder*>(scene.side)) {}
  };
  static constexpr bool kNearFirst = false;

  template <class Leaf, class Counts>
  static HWY_INLINE bool walk(const SceneView& scene, State& state, const WalkRay& ray, const float& limit, Leaf&& leaf,
                              Counts& counts) {
    const Interval at = clip_to_root(ray, *scene.tree);
    if (!(at.t0 <= at.t1)) return false;
    if (HWY_UNLIKELY(!state.order)) return stack_walk(*scene.tree, 0, at, ray, limit, leaf, counts);
    const auto first_child = [order = state.order](std::uint32_t node, std::uint32_t near) {
      return (near & ~1u) | (order->is_high_first(node) ? 1u : 0u);
    };
    return ordered_walk(*scene.tree, at, ray, first_child, leaf, counts);
  }
};

const EntryPoints& ordered() { return entry_points<TreeKernel<OrderedWalk>>(); }

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace umbrix::detail {
namespace {
HWY_EXPORT(ordered);
}

const EntryPoints& ordered_entry_points() { return HWY_DYNAMIC_DISPATCH(ordered)(); }

}  // namespace umbrix::detail
#endif
