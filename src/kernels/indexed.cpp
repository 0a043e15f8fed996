// SPDX-License-Identifier: Apache-2.0
// The stack walk that tests lists of likely blockers on the inner nodes it enters ("multi-index tree", Liang & Huang
// 2019). They are tested against the whole ray: a hit anywhere ends it. The paper's mailbox, by which a triangle is not
// tested twice, is left out: no triangle is twice on one path from the root, and one test in some hundreds is all that
// remembering them spared.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/indexed.cpp"

#include "kernels/indexed.h"

#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

#include "core/parallel_for.h"
#include "index/select_learned.h"
#include "index/select_paper.h"
#include "kernels/indexed_walk-inl.h"
#include "kernels/tree_kernel-inl.h"

#ifndef UMBRIX_KERNELS_INDEXED_FALLBACK_  // this file is compiled several times over
#define UMBRIX_KERNELS_INDEXED_FALLBACK_
namespace umbrix::detail {
extern const Kernel kStandardKernel;
}
#endif

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {
namespace {

bool has_lists(const SceneView& scene) { return IndexedKernel::has_lists(scene); }

// Without lists, and for closest hits, of which lists say nothing, the standard walk is asked itself.
void occluded(const SceneView& scene, RaySpan rays, std::uint8_t* out, const QueryOptions& options) {
  if (has_lists(scene))
    occluded_each<IndexedKernel>(scene, rays, out, options);
  else
    kStandardKernel.entry_points().occluded(scene, rays, out, options);
}
void occluded_counted(const SceneView& scene, RaySpan rays, std::uint8_t* out, const QueryOptions& options,
                      OcclusionCounts& counts) {
  if (has_lists(scene))
    occluded_each_counted<IndexedKernel>(scene, rays, out, options, counts);
  else
    kStandardKernel.entry_points().occluded_counted(scene, rays, out, options, counts);
}
void closest(const SceneView& scene, RaySpan rays, Hit* out, const QueryOptions& options) {
  kStandardKernel.entry_points().closest(scene, rays, out, options);
}
void closest_counted(const SceneView& scene, RaySpan rays, Hit* out, const QueryOptions& options, RayCounts& counts) {
  kStandardKernel.entry_points().closest_counted(scene, rays, out, options, counts);
}

const EntryPoints kEntryPoints = {&occluded, &occluded_counted, &closest, &closest_counted};
const EntryPoints& indexed() { return kEntryPoints; }
const EntryPoints& indexed_paper() { return kEntryPoints; }

struct WatchEnding : CountEach {
  const Block* block = nullptr;
  std::uint32_t blocker = Primitive::kNone;

  bool blocked_by(const Block& where, std::uint32_t lane) noexcept {
    block = &where;
    blocker = where.id[lane];
    return true;
  }
};

template <class K>
void watch_each(const SceneView& scene, RaySpan rays, const Primitive* skip, Ending* out) {
  Filter filter(scene, 0xFFFFFFFFu);
  typename K::State state(scene);
  const auto* const index = static_cast<const PrimitiveIndex*>(scene.side);
  for (std::size_t i = 0; i < rays.count; ++i) {
    if (skip) filter.set_skip(skip[i]);
    WatchEnding watch;
    K::occluded(scene, filter, rays[i], state, watch);
    out[i] = {watch.blocker, watch.block, index && index->holds(watch.block),
              static_cast<std::uint32_t>(watch.counts.node_tests),
              static_cast<std::uint32_t>(watch.counts.primitive_tests)};
  }
}

void endings_of(const SceneView& scene, RaySpan rays, const Primitive* skip, Ending* out) {
  if (has_lists(scene))
    watch_each<IndexedKernel>(scene, rays, skip, out);
  else
    watch_each<TreeKernel<StackWalk>>(scene, rays, skip, out);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace umbrix::detail {
namespace {

HWY_EXPORT(endings_of);

/// More say little more, and cost time before each frame.
constexpr std::size_t kMostTrainingRays = 65536;

std::unique_ptr<SideTable> make_paper_index(const PrepareInput& input) {
  const SceneView& scene = input.scene;
  return std::make_unique<PrimitiveIndex>(*scene.tree, scene.triangles,
                                          select_paper(*scene.tree, scene.triangles, scene.kept, scene.kept_count));
}

std::unique_ptr<SideTable> make_index(const PrepareInput& input) {
  const Training& training = input.training;
  if (training.rays.count == 0) return make_paper_index(input);
  const std::size_t count = std::min(training.rays.count, kMostTrainingRays);
  std::vector<Ray> rays(count);
  std::vector<Primitive> skip(training.skip ? count : 0);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t pick = i * training.rays.count / count;
    rays[i] = training.rays[pick];
    if (training.skip) skip[i] = training.skip[pick];
  }
  const RaySpan span{rays.data(), count};
  const std::vector<Ending> endings =
      find_endings(input.scene, span, training.skip ? skip.data() : nullptr, training.executor);
  std::vector<std::uint32_t> blockers(count);
  std::transform(endings.begin(), endings.end(), blockers.begin(), [](const Ending& e) { return e.blocker; });
  return std::make_unique<PrimitiveIndex>(*input.scene.tree, input.scene.triangles,
                                          select_learned(*input.scene.tree, {span, blockers.data()}));
}

}  // namespace

std::vector<Ending> find_endings(const SceneView& scene, RaySpan rays, const Primitive* skip,
                                 const Executor* executor) {
  constexpr std::size_t kChunk = 1024;
  std::vector<Ending> out(rays.count);
  parallel_for(executor, (rays.count + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    const std::size_t first = chunk * kChunk;
    const RaySpan part{&rays[first], std::min(kChunk, rays.count - first), rays.stride};
    HWY_DYNAMIC_DISPATCH(endings_of)(scene, part, skip ? skip + first : nullptr, out.data() + first);
  });
  return out;
}

}  // namespace umbrix::detail
UMBRIX_DEFINE_KERNEL(kIndexedKernel, indexed, "indexed",
                     "the stack walk with likely blockers on inner nodes, learned from rays", make_index)
UMBRIX_DEFINE_KERNEL(kIndexedPaperKernel, indexed_paper, "indexed-paper", "the same with blockers chosen by their size",
                     make_paper_index)
#endif
