// SPDX-License-Identifier: Apache-2.0
// All rays to a light as the light sees them (light_trace-inl.h); what that is not for goes in groups that share a
// walk of the tree, and first meets what blocked the rays before (group-inl.h), or as long as it is not worth a tree
// ray by ray through the boxes (bvh_walk-inl.h). Nearest hits of rays from one point go in packets
// (closest_trace-inl.h). Queries that count work build the tree first, so that counts do not
// depend on what was asked before. The default.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/auto.cpp"

#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

#include "kernels/batch-inl.h"
#include "kernels/bvh_kernel-inl.h"
#include "kernels/closest_trace-inl.h"
#include "kernels/light_trace-inl.h"
#include "kernels/near_rays.h"
#include "kernels/ray_blocks.h"
#include "kernels/shaft_trace-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {
namespace {

struct AutoKernel {
  using Others = BatchKernel<true>;

  static void occluded(const SceneView& scene, RaySpan rays, std::uint8_t* out, const QueryOptions& options) {
    for_parts(rays, options, [&](RaySpan part, std::size_t begin, const QueryOptions& here) {
      GroupRays shared{part, out + begin, here.skip, here.mask};
      shared.executor = here.executor;
      if (here.executor && trace<NoCounts>(scene, shared)) return;
      ShaftPatience patience;
      for_blocks(part, here, [&](RaySpan block, std::size_t first, const QueryOptions& its) {
        const GroupRays group{block, out + begin + first, its.skip, its.mask};
        if (trace_shafts(scene, group, patience) || trace<NoCounts>(scene, group)) return;
        answer_others(scene, block, out + begin + first, its);
      });
    });
  }

  static void occluded_counted(const SceneView& scene, RaySpan rays, std::uint8_t* out, const QueryOptions& options,
                               OcclusionCounts& counts) {
    for_parts(rays, options, [&](RaySpan part, std::size_t begin, const QueryOptions& here) {
      WorkSums sums;
      const GroupRays group{part, out + begin, here.skip, here.mask, nullptr, nullptr, &sums};
      if (trace<CountEach>(scene, group)) {
        counts.occluded += sums.counts.occluded;
        counts.unoccluded += sums.counts.unoccluded;
      } else if (const WideTree* const wide = wants_groups(scene, part) ? table(scene).need_wide() : nullptr) {
        Others::occluded_counted(with_side(scene, wide), part, out + begin, here, counts);
      } else {
        occluded_each_counted<BvhKernel>(scene, part, out + begin, here, counts);
      }
    });
  }

  static void closest(const SceneView& scene, RaySpan rays, Hit* out, const QueryOptions& options) {
    ClosestTrace(scene, options).trace(rays, out, [&](std::size_t first, std::size_t count) {
      QueryOptions here = options;
      if (here.skip) here.skip += first;
      const RaySpan part{&rays[first], count, rays.stride};
      closest_each<BvhKernel>(scene, part, out + first, here);
    });
  }

  static void closest_counted(const SceneView& scene, RaySpan rays, Hit* out, const QueryOptions& options,
                              RayCounts& counts) {
    closest_each_counted<BvhKernel>(scene, rays, out, options, counts);
  }

 private:
  template <class Counts>
  static bool trace(const SceneView& scene, const GroupRays& rays) {
    return scene.side && LightTrace<Counts>(scene, table(scene)).trace(rays);
  }

  static const LightViewTable& table(const SceneView& scene) { return *static_cast<const LightViewTable*>(scene.side); }

  static bool wants_groups(const SceneView& scene, const RaySpan& rays) {
    return scene.side && rays.count >= Others::kFewRays && go_together(rays, *scene.tree);
  }

  static SceneView with_side(const SceneView& scene, const WideTree* wide) {
    SceneView result = scene;
    result.side = wide;
    return result;
  }

  static bool trace_shafts(const SceneView& scene, const GroupRays& rays, ShaftPatience& patience) {
    if (!scene.side) return false;
    const auto answer = [&](auto&& by, std::size_t first, std::size_t count) {
      QueryOptions options;
      options.mask = rays.mask;
      options.skip = rays.skip ? rays.skip + first : nullptr;
      by(scene, RaySpan{&rays.rays[first], count, rays.rays.stride}, rays.out + first, options);
    };
    return ShaftTrace(scene, table(scene), patience).trace(rays, [&](std::size_t first, std::size_t count) {
      answer(answer_others, first, count);
    });
  }

  static void answer_others(const SceneView& scene, RaySpan rays, std::uint8_t* out, const QueryOptions& options) {
    if (const WideTree* const wide = wants_groups(scene, rays) ? table(scene).earn_wide(rays.count) : nullptr)
      Others::occluded(with_side(scene, wide), rays, out, options);
    else
      occluded_each<BvhKernel>(scene, rays, out, options);
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
  static constexpr EntryPoints kEntryPoints = {&AutoKernel::occluded, &AutoKernel::occluded_counted,
                                               &AutoKernel::closest, &AutoKernel::closest_counted, true};
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
  auto table = std::make_unique<LightViewTable>(*s.bvh, *s.lazy_tree, s.triangles);
  if (s.lazy_tree->is_built()) table->make_wide(input.training.executor);
  return table;
}

}  // namespace
}  // namespace umbrix::detail
UMBRIX_DEFINE_TREELESS_KERNEL(kAutoKernel, auto_entry_points, "auto",
                              "all rays to a light in one walk, as the light sees them; other rays in groups",
                              make_light_view)
#endif
