// SPDX-License-Identifier: Apache-2.0
// All rays to a light as the light sees them (light_trace-inl.h); what that is not for goes in groups that share a
// walk, and first meets what blocked the rays before (group-inl.h). The default.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/auto.cpp"

#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

#include "kernels/batch-inl.h"
#include "kernels/light_trace-inl.h"
#include "kernels/shaft_trace-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {
namespace {

struct AutoKernel {
  using Others = BatchKernel<true>;

  static void occluded(const SceneView& scene, RaySpan rays, std::uint8_t* out, const QueryOptions& options) {
    for_parts(rays, options, [&](RaySpan part, std::size_t begin, const QueryOptions& here) {
      const GroupRays group{part, out + begin, here.skip, here.mask};
      if (!trace_shafts(scene, group) && !trace<NoCounts>(scene, group))
        Others::occluded(scene, part, out + begin, here);
    });
  }

  static void occluded_counted(const SceneView& scene, RaySpan rays, std::uint8_t* out, const QueryOptions& options,
                               OcclusionCounts& counts) {
    for_parts(rays, options, [&](RaySpan part, std::size_t begin, const QueryOptions& here) {
      WorkSums sums;
      const GroupRays group{part, out + begin, here.skip, here.mask, nullptr, nullptr, &sums};
      if (!trace<CountEach>(scene, group)) {
        Others::occluded_counted(scene, part, out + begin, here, counts);
        return;
      }
      counts.occluded += sums.counts.occluded;
      counts.unoccluded += sums.counts.unoccluded;
    });
  }

 private:
  template <class Counts>
  static bool trace(const SceneView& scene, const GroupRays& rays) {
    return scene.side && LightTrace<Counts>(scene, *static_cast<const LightViewTable*>(scene.side)).trace(rays);
  }

  static bool trace_shafts(const SceneView& scene, const GroupRays& rays) {
    if (!scene.side) return false;
    const auto part = [&](auto&& answer, std::size_t first, std::size_t count) {
      QueryOptions options;
      options.mask = rays.mask;
      options.skip = rays.skip ? rays.skip + first : nullptr;
      answer(scene, RaySpan{&rays.rays[first], count, rays.rays.stride}, rays.out + first, options);
    };
    return ShaftTrace(scene, *static_cast<const LightViewTable*>(scene.side))
        .trace(
            rays, [&](std::size_t first, std::size_t count) { part(Others::occluded, first, count); },
            [&](std::size_t first, std::size_t count) { part(occluded_each<Others::Single>, first, count); });
  }

  template <class Each>
  static void for_parts(RaySpan rays, QueryOptions options, Each&& each) {
    for (std::size_t begin = 0; begin < rays.count; begin += kMostViewRays) {
      const std::size_t count = std::min(kMostViewRays, rays.count - begin);
      each(RaySpan{&rays[begin], count, rays.stride}, begin, options);
      if (options.skip) options.skip += count;
    }
  }
};

const EntryPoints& auto_entry_points() {
  using Closest = TreeKernel<StackWalk>;
  static constexpr EntryPoints kEntryPoints = {&AutoKernel::occluded, &AutoKernel::occluded_counted,
                                               &closest_each<Closest>, &closest_each_counted<Closest>};
  return kEntryPoints;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace umbrix::detail {
namespace {

std::unique_ptr<SideTable> make_light_view(const PrepareInput& input) {
  const SceneView& s = input.scene;
  return std::make_unique<LightViewTable>(*s.tree, s.triangles, s.kept, s.kept_count, input.training.executor);
}

}  // namespace
}  // namespace umbrix::detail
UMBRIX_DEFINE_KERNEL(kAutoKernel, auto_entry_points, "auto",
                     "all rays to a light in one walk, as the light sees them; other rays in groups", make_light_view)
#endif
