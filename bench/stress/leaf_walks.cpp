// SPDX-License-Identifier: Apache-2.0
//
// The two walks of the kernels themselves, told to note the leaves that they visit. Cells through which a ray passes in
// no time may be visited or not. For one instruction set: the walks use none.
#include <fmt/core.h>
#include <hwy/highway.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "cases/built_tree.h"
#include "cases/families.h"
#include "kernels/link_walk-inl.h"
#include "stress/checks.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {
namespace {

// Leaves by their first block, in order of number.
struct Visited {
  std::vector<std::uint32_t> all;
  std::vector<std::uint32_t> for_some_time;

  auto observer() {
    return [this](BlockRun run, float t0, float t1) {
      all.push_back(run.first);
      if (t0 < t1) for_some_time.push_back(run.first);
      return false;
    };
  }
  void sort() {
    std::sort(all.begin(), all.end());
    std::sort(for_some_time.begin(), for_some_time.end());
  }
  bool covers(const Visited& other) const {
    return std::includes(all.begin(), all.end(), other.for_some_time.begin(), other.for_some_time.end());
  }
};

struct Comparison {
  std::uint64_t rays = 0;
  std::uint64_t different = 0;
  std::uint64_t missing_links = 0;
};

void compare_walks(const Tree& tree, const Links& links, const Ray& ray, LinkStart& start, Comparison& out) {
  WalkRay walk;
  if (!is_valid(ray) || prepare(ray, tree, walk) != Reach::near) return;
  const Interval at = clip_to_root(walk, tree);
  if (!(at.t0 <= at.t1)) return;
  const float limit = std::numeric_limits<float>::infinity();
  Visited by_stack, by_links;
  CountEach counts;
  stack_walk(tree, 0, at, walk, limit, by_stack.observer(), counts);
  link_walk(tree, links, start, at, walk, limit, by_links.observer(), counts);
  by_stack.sort();
  by_links.sort();
  ++out.rays;
  out.different += by_stack.covers(by_links) && by_links.covers(by_stack) ? 0 : 1;
  out.missing_links += counts.counts.links_missing;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

namespace umbrix::bench {
namespace {

constexpr std::size_t kRaysPerScene = 20'000;

detail::HWY_NAMESPACE::Comparison compare_scene(cases::Make* make, std::uint64_t seed, std::size_t rays,
                                                detail::LinkBuilder builder) {
  const cases::CaseData data = make(seed, rays);
  const detail::Tree tree = cases::built_tree(data.triangles);
  detail::Links links(tree, builder);
  if (builder == detail::LinkBuilder::full) links.build_full(nullptr);
  detail::HWY_NAMESPACE::LinkStart start;
  detail::HWY_NAMESPACE::Comparison result;
  for (const Ray& ray : data.rays) detail::HWY_NAMESPACE::compare_walks(tree, links, ray, start, result);
  return result;
}

}  // namespace

Status check_leaf_walks(const StressSettings& settings, std::size_t rays, Counts& out) {
  cases::Make* const makes[] = {cases::tree_planes,   cases::tree_corners, cases::random_segments,
                                cases::axis_parallel, cases::translated,   cases::silhouettes,
                                cases::box_corners,   cases::mixed_scale,  cases::nested_sizes};
  const std::size_t scenes = std::max((rays + kRaysPerScene - 1) / kRaysPerScene, std::size(makes));
  std::vector<detail::HWY_NAMESPACE::Comparison> found(scenes);
  tbb::parallel_for(std::size_t{0}, scenes, [&](std::size_t i) {
    const auto builder = i / std::size(makes) % 2 == 0 ? detail::LinkBuilder::lazy : detail::LinkBuilder::full;
    found[i] = compare_scene(makes[i % std::size(makes)], settings.seed * 1'000'003 + i, (rays + scenes - 1) / scenes,
                             builder);
  });
  std::uint64_t missing = 0;
  for (const auto& f : found) {
    out.rays += f.rays;
    out.different += f.different + f.missing_links;
    missing += f.missing_links;
  }
  if (out.different > 0) {
    out.notes.push_back(fmt::format("{} rays with other leaves, {} links missing", out.different - missing, missing));
  }
  return {};
}

}  // namespace umbrix::bench
