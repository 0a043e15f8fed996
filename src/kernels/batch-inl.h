// SPDX-License-Identifier: Apache-2.0
// The queries of kernels that answer rays in groups. Few rays are not worth a group; hits that come first are looked
// for by the stack walk.

#if defined(UMBRIX_KERNELS_BATCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_BATCH_INL_H_
#undef UMBRIX_KERNELS_BATCH_INL_H_
#else
#define UMBRIX_KERNELS_BATCH_INL_H_
#endif

#include <hwy/highway.h>

#include "kernels/group-inl.h"
#include "kernels/wide_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

/// A kernel of groups, with or without candidates from the rays before.
template <bool kTryCandidates>
struct BatchKernel {
  static constexpr std::size_t kFewRays = 8;
  using Single = TreeKernel<WideWalk>;

  static void occluded(const SceneView& scene, RaySpan rays, std::uint8_t* out, const QueryOptions& options) {
    if (rays.count < kFewRays || !scene.side) {
      occluded_each<Single>(scene, rays, out, options);
      return;
    }
    NoMemory memory;
    const GroupRays group_rays{rays, out, options.skip, options.mask};
    const auto& tree = *static_cast<const WideTree*>(scene.side);
    Group<NoMemory, NoCounts>(scene, tree, group_rays, memory, kTryCandidates).trace();
  }

  static void occluded_counted(const SceneView& scene, RaySpan rays, std::uint8_t* out, const QueryOptions& options,
                               OcclusionCounts& counts) {
    if (rays.count < kFewRays || !scene.side) {
      occluded_each_counted<Single>(scene, rays, out, options, counts);
      return;
    }
    NoMemory memory;
    WorkSums sums;
    const GroupRays group_rays{rays, out, options.skip, options.mask, nullptr, nullptr, &sums};
    const auto& tree = *static_cast<const WideTree*>(scene.side);
    Group<NoMemory, CountEach>(scene, tree, group_rays, memory, kTryCandidates).trace();
    counts.occluded += sums.counts.occluded;
    counts.unoccluded += sums.counts.unoccluded;
  }
};

template <bool kTryCandidates>
const EntryPoints& batch_entry_points() {
  using Batch = BatchKernel<kTryCandidates>;
  using Closest = TreeKernel<StackWalk>;
  static constexpr EntryPoints kEntryPoints = {&Batch::occluded, &Batch::occluded_counted, &closest_each<Closest>,
                                               &closest_each_counted<Closest>};
  return kEntryPoints;
}

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
