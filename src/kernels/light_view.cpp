// SPDX-License-Identifier: Apache-2.0
// All shadow rays to a light together, as an irregular z-buffer: see light_walk-inl.h.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/light_view.cpp"

#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "kernels/light_packets-inl.h"
#include "kernels/light_walk-inl.h"
#include "kernels/queries-inl.h"
#include "kernels/tree_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {
namespace {

double now() { return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

void light_view_occluded(const SceneView& scene, RaySpan rays, std::uint8_t* out, const QueryOptions& options) {
  using Single = TreeKernel<StackWalk>;
  if (rays.count < 64 || !scene.side) {
    occluded_each<Single>(scene, rays, out, options);
    return;
  }
  const auto& table = *static_cast<const LightViewTable*>(scene.side);
  auto scratch = table.borrow();
  const double t0 = now();
  LightRays light_rays(*scene.tree, rays, *scratch);
  if (!light_rays.read()) {
    table.give_back(std::move(scratch));
    occluded_each<Single>(scene, rays, out, options);
    return;
  }
  const double t1 = now();
  std::memset(out, 0, rays.count);
  const GroupRays group_rays{rays, out, options.skip, options.mask};
  const bool may_cover = !options.skip && Filter(scene, options.mask).passes_all();
  LightWalk(table.bvh(), light_rays.light(), light_rays.errors(), may_cover, *scratch).walk();
  const double t2 = now();
  LightPackets packets(scene, group_rays, *scratch);
  packets.trace();
  const double t3 = now();
  Filter filter(scene, options.mask);
  for (const std::uint32_t i : scratch->odd) {
    if (options.skip) filter.set_skip(options.skip[i]);
    typename Single::State state(scene);
    NoCounts none;
    out[i] = Single::occluded(scene, filter, rays[i], state, none);
  }
  const double t4 = now();
  if (getenv("LV")) {
    std::size_t groups = 0;
    for (auto& f : scratch->faces) groups += f.groups.size();
    std::size_t lanes = 0, edge_on = 0;
    for (auto& m : scratch->meetings) lanes += hwy::PopCount(m.lanes), edge_on += hwy::PopCount(m.edge_on);
    std::printf("layers %.2f rays %.2f walk %.2f packets %.2f odd %.2f ms; groups %zu rows kept %zu meetings %zu lanes %zu edge-on %zu exact %lu odd %zu err %g %g\n", double(light_rays.layers()), t1 - t0,
                t2 - t1, t3 - t2, t4 - t3, groups, std::size_t{scratch->triangle_count}, scratch->meetings.size(), lanes, edge_on, packets.exact_, scratch->odd.size(), double(light_rays.errors().end), double(light_rays.errors().most));
  }
  table.give_back(std::move(scratch));
}

const EntryPoints& light_view_entry_points() {
  using Closest = TreeKernel<StackWalk>;
  static constexpr EntryPoints kEntryPoints = {&light_view_occluded, &occluded_each_counted<TreeKernel<StackWalk>>,
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
  const double t0 = N_AVX3::now();
  auto bvh = std::make_unique<TriangleBvh>(s.triangles, s.kept, s.kept_count, s.tree->scale_exponent);
  if (getenv("LV")) std::printf("bvh %.1f ms, %zu rows for %zu triangles\n", N_AVX3::now() - t0, bvh->rows_count(), s.kept_count);
  return std::make_unique<LightViewTable>(std::move(bvh));
}
}  // namespace
}  // namespace umbrix::detail
UMBRIX_DEFINE_KERNEL(kLightViewKernel, light_view_entry_points, "light-view",
                     "all rays to a light in one walk, as the light sees them", make_light_view)
#endif
