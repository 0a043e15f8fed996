// SPDX-License-Identifier: Apache-2.0
#include "stress/counts.h"

#include <algorithm>

#include "umbrix/kernel.h"

namespace umbrix::bench {
namespace {

double per_million(std::uint64_t part, std::uint64_t all) {
  return all == 0 ? 0 : 1e6 * static_cast<double>(part) / static_cast<double>(all);
}

nlohmann::json wrong_json(const WrongRays& wrong, std::uint64_t rays) {
  return {{"leaks", wrong.leaks},
          {"false_shadows", wrong.false_shadows},
          {"wrong", wrong.total()},
          {"per_million", per_million(wrong.total(), rays)}};
}

nlohmann::json answers_json(const judge::AnswerCounts& answers) {
  nlohmann::json kernels = nlohmann::json::object();
  for (std::size_t k = 0; k < kernel_count(); ++k) {
    nlohmann::json targets = nlohmann::json::object();
    for (std::size_t t = 0; t < simd_target_count(); ++t) targets[simd_target_name(t)] = answers.of(k, t);
    kernels[kernel_info(k).name] = std::move(targets);
  }
  return kernels;
}

}  // namespace

void WrongRays::add(const WrongRays& other) {
  leaks += other.leaks;
  false_shadows += other.false_shadows;
}

void Counts::add(const Counts& other) {
  rays += other.rays;
  occluded += other.occluded;
  by_oracle += other.by_oracle;
  answers.add(other.answers);
  ours.add(other.ours);
  closest_wrong += other.closest_wrong;
  refuted += other.refuted;
  different += other.different;
  embree_rays += other.embree_rays;
  embree_robust.add(other.embree_robust);
  embree_fast.add(other.embree_fast);
  embree_robust_at_ends += other.embree_robust_at_ends;
  embree_fast_at_ends += other.embree_fast_at_ends;
  seconds += other.seconds;
  slowest_build = std::max(slowest_build, other.slowest_build);
  largest_scene = std::max(largest_scene, other.largest_scene);
  notes.insert(notes.end(), other.notes.begin(), other.notes.end());
}

nlohmann::json Counts::to_json() const {
  return {{"rays", rays},
          {"occluded", occluded},
          {"by_oracle", by_oracle},
          {"answers", answers.total()},
          {"answers_by_kernel", answers_json(answers)},
          {"ours", wrong_json(ours, rays)},
          {"closest_wrong", closest_wrong},
          {"refuted", refuted},
          {"different", different},
          {"failures", failures()},
          {"embree_rays", embree_rays},
          {"embree_robust", wrong_json(embree_robust, embree_rays)},
          {"embree_robust_at_ends", embree_robust_at_ends},
          {"embree_fast", wrong_json(embree_fast, embree_rays)},
          {"embree_fast_at_ends", embree_fast_at_ends},
          {"seconds", seconds},
          {"slowest_build_seconds", slowest_build},
          {"largest_scene_bytes", largest_scene},
          {"notes", notes}};
}

}  // namespace umbrix::bench
