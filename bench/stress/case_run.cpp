// SPDX-License-Identifier: Apache-2.0
//
// A case runs in rounds. In a round some chunks of rays, each with a scene of its own, are judged side by side on one
// instruction set; then a small chunk is asked everything on all of them. A case with one scene is one chunk.
#include "stress/case_run.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "judge/minimise.h"
#include "report.h"
#include "stress/embree_errors.h"
#include "stress/regression_file.h"
#include "umbrix/umbrix.h"

namespace umbrix::bench {
namespace {

constexpr std::size_t kChunksPerRound = 6;
constexpr std::size_t kKernelsPerRay = 2;
constexpr std::size_t kFullChunk = 1500;     // rays that all kernels are asked
constexpr std::uint64_t kMostDescribed = 5;  // wrong answers shown for each case
// Kernels for scenes of more than a few hundred thousand triangles.
const char* const kHugeKernels[] = {"auto", "standard", "linked", "wide", "beam", "indexed", "srdh", "kd-restart"};

// Kernels that learn look at every triangle that blocks a ray: of a fan, a million.
constexpr std::size_t kHugeTraining = 32;

// One scene with its rays, and what came of it.
struct Chunk {
  std::uint64_t seed = 0;
  std::size_t rays = 0;
  judge::Options options;
  Status status;
  Counts counts;
  std::vector<judge::Complaint> complaints;  // the first ones
};

// A ray that several kernels answer wrongly counts once.
void count_complaints(const std::vector<judge::Complaint>& complaints, Counts& out) {
  std::set<std::size_t> leaks, false_shadows, closest;
  for (const judge::Complaint& complaint : complaints) {
    const bool is_closest = complaint.question.query == judge::Query::closest;
    (is_closest ? closest : complaint.given == 0 ? leaks : false_shadows).insert(complaint.ray);
  }
  out.ours.leaks += leaks.size();
  out.ours.false_shadows += false_shadows.size();
  out.closest_wrong += closest.size();
}

Status judge_chunk(const cases::Case& c, Chunk& chunk) {
  const cases::CaseData data = c.make(chunk.seed, chunk.rays);
  judge::Result result;
  if (Status status = judge::judge(data, chunk.options, result); !status) return status;
  Counts& counts = chunk.counts;
  counts.rays += data.rays.size();
  for (const std::uint8_t occluded : result.truth.occluded) counts.occluded += occluded;
  counts.by_oracle += result.truth.by_oracle;
  counts.refuted += result.truth.refuted.size();
  counts.answers.add(result.answers);
  counts.slowest_build = result.build.seconds;
  counts.largest_scene = result.build.bytes;
  count_complaints(result.complaints, counts);
  for (const std::size_t ray : result.truth.refuted) {
    if (counts.notes.size() >= kMostDescribed) break;
    counts.notes.push_back(fmt::format("{}: ray {} of seed {} is not as claimed", c.name, ray, chunk.seed));
  }
  chunk.complaints.assign(result.complaints.begin(),
                          result.complaints.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(
                                                          result.complaints.size(), kMostDescribed)));
  return count_embree_errors(data, result.truth.occluded, counts);
}

// Shows a chunk's wrong answers and keeps them in the regression file.
Status describe(const cases::Case& c, const StressSettings& settings, const Chunk& chunk) {
  if (chunk.complaints.empty()) return {};
  const cases::CaseData data = c.make(chunk.seed, chunk.rays);
  std::vector<judge::Regression> kept;
  for (const judge::Complaint& complaint : chunk.complaints) {
    const judge::Failure failure = judge::minimise(data, complaint);
    fmt::print("wrong: {} seed {} rays {}: {}\n", c.name, chunk.seed, chunk.rays, failure.text);
    std::fflush(stdout);
    if (failure.triangles.empty()) continue;  // not wrong when asked alone
    kept.push_back(
        {fmt::format("{} seed {} {}", c.name, chunk.seed, complaint.question.kernel), failure.triangles, failure.ray});
  }
  std::size_t added = 0;
  return settings.regressions.empty() ? Status() : append_regressions(settings.regressions, kept, &added);
}

judge::TruthOptions truth_options(const cases::Case& c, std::size_t closest_rays, bool trust_claim) {
  judge::TruthOptions options;
  options.claim = c.claim;
  options.trust_claim = trust_claim && c.is_proved;
  options.closest_rays = closest_rays;
  return options;
}

std::size_t share_of(std::size_t rays, double share) {
  return static_cast<std::size_t>(std::ceil(static_cast<double>(rays) * share));
}

// All kernels on all instruction sets, about a quarter of the rays for their closest hits too.
Chunk full_chunk(const cases::Case& c, std::uint64_t seed, std::size_t rays) {
  Chunk chunk;
  chunk.seed = seed;
  chunk.rays = rays;
  chunk.options.targets = judge::Targets::all;
  chunk.options.rays_on_each_target = std::min(rays, kFullChunk);
  chunk.options.kernels_per_ray = kKernelsPerRay;
  chunk.options.mode = c.mode;
  if (c.is_huge) {
    chunk.options.kernels.assign(std::begin(kHugeKernels), std::end(kHugeKernels));
    chunk.options.training_rays = kHugeTraining;
  }
  chunk.options.truth = truth_options(c, share_of(std::min(rays, kFullChunk), c.closest_share), false);
  return chunk;
}

// Two kernels on the instruction set in use.
Chunk turn_chunk(const cases::Case& c, std::uint64_t seed, std::size_t rays, std::size_t turn, std::size_t target) {
  Chunk chunk;
  chunk.seed = seed;
  chunk.rays = rays;
  for (std::size_t k = 0; k < kKernelsPerRay; ++k) {
    chunk.options.kernels.emplace_back(kernel_info((turn * kKernelsPerRay + k) % kernel_count()).name);
  }
  chunk.options.current_target = target;
  chunk.options.mode = c.mode;
  chunk.options.truth = truth_options(c, 0, true);
  return chunk;
}

Status finish(const cases::Case& c, const StressSettings& settings, const Chunk& chunk, Counts& out) {
  if (!chunk.status) {
    return {chunk.status.code(), fmt::format("{} seed {}: {}", c.name, chunk.seed, chunk.status.message())};
  }
  out.add(chunk.counts);
  return describe(c, settings, chunk);
}

// Some chunks side by side on one instruction set.
Status run_turns(const cases::Case& c, const StressSettings& settings, std::size_t target, std::vector<Chunk>& chunks,
                 Counts& out) {
  if (Status status = use_simd_target(simd_target_name(target)); !status) return status;
  tbb::parallel_for(std::size_t{0}, chunks.size(),
                    [&](std::size_t i) { chunks[i].status = judge_chunk(c, chunks[i]); });
  if (Status status = use_simd_target(nullptr); !status) return status;
  for (const Chunk& chunk : chunks) {
    if (Status status = finish(c, settings, chunk, out); !status) return status;
  }
  return {};
}

}  // namespace

Status run_case(const cases::Case& c, const StressSettings& settings, Counts& out) {
  const double start = wall_seconds();
  const std::size_t rays = static_cast<std::size_t>(std::ceil(c.rays * settings.scale));
  std::uint64_t seed = settings.seed * 1'000'003;
  std::size_t asked = 0, turn = 0;
  for (std::size_t round = 0; asked < rays; ++round) {
    Chunk full = full_chunk(c, seed++, c.rays_per_scene >= rays ? rays - asked : std::min(rays - asked, kFullChunk));
    full.status = judge_chunk(c, full);
    asked += full.rays;
    if (Status status = finish(c, settings, full, out); !status) return status;

    std::vector<Chunk> chunks;
    const std::size_t target = round % simd_target_count();
    while (chunks.size() < kChunksPerRound && asked < rays) {
      const std::size_t part = (rays - asked + kChunksPerRound - chunks.size() - 1) / (kChunksPerRound - chunks.size());
      chunks.push_back(turn_chunk(c, seed++, std::min(c.rays_per_scene, part), turn++, target));
      asked += chunks.back().rays;
    }
    if (Status status = run_turns(c, settings, target, chunks, out); !status) return status;
  }
  out.seconds += wall_seconds() - start;
  return {};
}

}  // namespace umbrix::bench
