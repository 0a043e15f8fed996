// SPDX-License-Identifier: Apache-2.0
// The loops over rays, the same for every kernel: compiled once for each instruction set, so that a kernel's walk is
// inlined. A kernel class has
//   using State = ...;  what lasts from ray to ray of one call; made from a SceneView
//   template <class Counts> static bool occluded(const SceneView&, const Filter&, const Ray&, State&, Counts&);
//   template <class Counts> static void closest(const SceneView&, const Filter&, const Ray&, State&, Nearest&,
//   Counts&);

#if defined(UMBRIX_KERNELS_QUERIES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_QUERIES_INL_H_
#undef UMBRIX_KERNELS_QUERIES_INL_H_
#else
#define UMBRIX_KERNELS_QUERIES_INL_H_
#endif

#include <hwy/highway.h>

#include "kernels/counts.h"
#include "kernels/kernel.h"
#include "kernels/scene_view.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

inline Hit to_hit(const SceneView& scene, const Nearest& nearest) {
  Hit hit;
  if (!nearest.found()) return hit;
  hit.t = static_cast<float>(nearest.hit.parameters.t);
  hit.u = static_cast<float>(nearest.hit.parameters.u);
  hit.v = static_cast<float>(nearest.hit.parameters.v);
  hit.primitive.mesh = scene.mesh_of[nearest.id];
  hit.primitive.triangle = nearest.id - scene.meshes[hit.primitive.mesh].first_triangle;
  return hit;
}

template <class K>
void occluded_each(const SceneView& scene, RaySpan rays, std::uint8_t* out, const QueryOptions& options) {
  Filter filter(scene, options.mask);
  typename K::State state(scene);
  NoCounts none;
  for (std::size_t i = 0; i < rays.count; ++i) {
    if (options.skip) filter.set_skip(options.skip[i]);
    out[i] = K::occluded(scene, filter, rays[i], state, none);
  }
}

template <class K>
void occluded_each_counted(const SceneView& scene, RaySpan rays, std::uint8_t* out, const QueryOptions& options,
                           OcclusionCounts& counts) {
  Filter filter(scene, options.mask);
  typename K::State state(scene);
  for (std::size_t i = 0; i < rays.count; ++i) {
    if (options.skip) filter.set_skip(options.skip[i]);
    CountEach each;
    out[i] = K::occluded(scene, filter, rays[i], state, each);
    (out[i] ? counts.occluded : counts.unoccluded) += each.counts;
  }
}

template <class K>
void closest_each(const SceneView& scene, RaySpan rays, Hit* out, const QueryOptions& options) {
  Filter filter(scene, options.mask);
  typename K::State state(scene);
  NoCounts none;
  for (std::size_t i = 0; i < rays.count; ++i) {
    if (options.skip) filter.set_skip(options.skip[i]);
    Nearest nearest;
    K::closest(scene, filter, rays[i], state, nearest, none);
    out[i] = to_hit(scene, nearest);
  }
}

template <class K>
void closest_each_counted(const SceneView& scene, RaySpan rays, Hit* out, const QueryOptions& options,
                          RayCounts& counts) {
  Filter filter(scene, options.mask);
  typename K::State state(scene);
  for (std::size_t i = 0; i < rays.count; ++i) {
    if (options.skip) filter.set_skip(options.skip[i]);
    CountEach each;
    Nearest nearest;
    K::closest(scene, filter, rays[i], state, nearest, each);
    out[i] = to_hit(scene, nearest);
    counts += each.counts;
  }
}

template <class K>
const EntryPoints& entry_points() {
  static constexpr EntryPoints kEntryPoints = {&occluded_each<K>, &occluded_each_counted<K>, &closest_each<K>,
                                               &closest_each_counted<K>};
  return kEntryPoints;
}

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
