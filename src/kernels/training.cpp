// SPDX-License-Identifier: Apache-2.0
#include "kernels/training.h"

#include "core/parallel_for.h"
#include "kernels/walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {
namespace {

constexpr std::size_t kMostRays = 65536;
constexpr std::size_t kRaysPerTask = 1024;
/// About as many of a ray's blockers are enough, and bound the memory in scenes of coincident triangles.
constexpr std::ptrdiff_t kMostBlockers = 1024;

/// Adds the ray and its blockers, each once.
void gather(const SceneView& scene, const Filter& filter, const Ray& ray, TrainingRays& out) {
  if (!is_valid(ray)) return;
  WalkRay walk_ray;
  if (prepare(ray, *scene.tree, walk_ray) == Reach::far) return;
  const Interval at = clip_to_root(walk_ray, *scene.tree);
  if (!(at.t0 <= at.t1)) return;
  const auto first = static_cast<std::ptrdiff_t>(out.blockers.size());
  NoCounts none;
  const auto collect = [&](BlockRun run, float, float) {
    for (std::uint32_t b = 0; b < run.count; ++b) {
      const Block& block = scene.tree->blocks[run.first + b];
      for (std::uint32_t lane = 0; lane < block.count; ++lane)
        if (blocks(scene, filter, ray, block.id[lane], none)) out.blockers.push_back(block.id[lane]);
    }
    return static_cast<std::ptrdiff_t>(out.blockers.size()) - first > kMostBlockers;
  };
  stack_walk(*scene.tree, 0, at, walk_ray, walk_ray.tmax, collect, none);
  std::sort(out.blockers.begin() + first, out.blockers.end());
  out.blockers.erase(std::unique(out.blockers.begin() + first, out.blockers.end()), out.blockers.end());

  TrainingRay result{};
  std::copy(walk_ray.origin, walk_ray.origin + 3, result.origin);
  std::copy(walk_ray.inverse, walk_ray.inverse + 3, result.inverse);
  result.t0 = at.t0;
  result.t1 = at.t1;
  result.first_blocker = static_cast<std::uint32_t>(first);
  result.blocker_count = static_cast<std::uint32_t>(out.blockers.size()) - result.first_blocker;
  out.rays.push_back(result);
}

TrainingRays gather_all(const PrepareInput& input) {
  const Training& training = input.training;
  const std::size_t count = std::min(training.rays.count, kMostRays);
  std::vector<TrainingRays> parts((count + kRaysPerTask - 1) / kRaysPerTask);
  parallel_for(training.executor, parts.size(), [&](std::size_t task) {
    const DefaultFloatMode mode;
    Filter filter(input.scene, 0xFFFFFFFFu);
    for (std::size_t i = task * kRaysPerTask; i < std::min(count, (task + 1) * kRaysPerTask); ++i) {
      const std::size_t picked = i * training.rays.count / count;
      if (training.skip) filter.set_skip(training.skip[picked]);
      gather(input.scene, filter, training.rays[picked], parts[task]);
    }
  });
  TrainingRays all;
  for (const TrainingRays& part : parts) {
    for (TrainingRay ray : part.rays) {
      ray.first_blocker += static_cast<std::uint32_t>(all.blockers.size());
      all.rays.push_back(ray);
    }
    all.blockers.insert(all.blockers.end(), part.blockers.begin(), part.blockers.end());
  }
  return all;
}

}  // namespace
}  // namespace HWY_NAMESPACE

TrainingRays gather_blockers(const PrepareInput& input) { return HWY_NAMESPACE::gather_all(input); }

}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();
