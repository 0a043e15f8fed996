// SPDX-License-Identifier: Apache-2.0
// The stack walk that tests lists of likely blockers on the inner nodes it enters; see indexed.cpp.

#if defined(UMBRIX_KERNELS_INDEXED_WALK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_INDEXED_WALK_INL_H_
#undef UMBRIX_KERNELS_INDEXED_WALK_INL_H_
#else
#define UMBRIX_KERNELS_INDEXED_WALK_INL_H_
#endif

#include <hwy/highway.h>

#include "index/primitive_index.h"
#include "kernels/tree_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

/// For scenes whose side table is an index with lists.
struct IndexedKernel {
  static bool has_lists(const SceneView& scene) {
    const auto* const index = static_cast<const PrimitiveIndex*>(scene.side);
    return index && !index->empty();
  }

  struct State {
    const PrimitiveIndex& index;

    explicit State(const SceneView& scene) : index(*static_cast<const PrimitiveIndex*>(scene.side)) {}
  };

  template <class Counts>
  static HWY_INLINE bool occluded(const SceneView& scene, const Filter& filter, const Ray& ray, State& state,
                                  Counts& counts) {
    return occluded_by(scene, filter, ray, counts, nullptr, [&](const WalkRay& walk_ray) {
      const Interval at = clip_to_root(walk_ray, *scene.tree);
      if (!(at.t0 <= at.t1)) return false;
      const LeafTest test(walk_ray);
      const auto leaf = [&](BlockRun run, float, float t1) {
        return leaf_blocks(scene, filter, ray, test, walk_ray, run, t1, counts);
      };
      const PrimitiveIndex::NodeBits has_list = state.index.has_list();
      const auto inner = [&, has_list](std::uint32_t node, float t0) {
        if (HWY_LIKELY(!has_list[node])) return false;
        const Block& list = state.index.list(node);
        counts.indexed(list.count);
        return block_blocks(scene, filter, ray, test, walk_ray, list, test.reach(list, t0), counts);
      };
      return stack_walk(*scene.tree, 0, at, walk_ray, walk_ray.tmax, leaf, counts, inner);
    });
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
