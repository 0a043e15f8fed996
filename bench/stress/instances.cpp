// SPDX-License-Identifier: Apache-2.0
//
// Scenes with instances against the same with each of them placed as a mesh: occlusion is judged by exact arithmetic
// over all placed triangles, closest hits must have the same bits.
#include <fmt/format.h>

#include <cstring>

#include "cases/instanced_meshes.h"
#include "stress/checks.h"
#include "stress/embree_errors.h"
#include "umbrix/umbrix.h"

namespace umbrix::bench {
namespace {

constexpr std::size_t kRaysPerScene = 4000;

Status judge_scene(cases::Placing placing, std::uint64_t seed, std::size_t kernel, std::size_t target, Counts& out) {
  const cases::InstancedMeshes meshes(placing, seed);
  const cases::CaseData data{meshes.triangles(), meshes.rays(kRaysPerScene, seed)};
  const RaySpan rays{data.rays.data(), data.rays.size()};
  Scene flat, instanced;
  if (Status status = meshes.build_flat(flat); !status) return status;
  if (Status status = meshes.build_instanced(instanced); !status) return status;

  QueryOptions options;
  options.kernel = {static_cast<int>(kernel)};
  std::vector<std::uint8_t> answers(data.rays.size());
  instanced.occluded(rays, answers.data(), options);
  const judge::Truth truth = judge::find_truth(data, {});
  const WrongRays wrong = count_wrong(answers, truth.occluded);

  std::vector<Hit> hits(data.rays.size()), expected(data.rays.size());
  instanced.closest(rays, hits.data(), options);
  flat.closest(rays, expected.data());
  std::uint64_t different = 0;
  for (std::size_t i = 0; i < hits.size(); ++i)
    different += std::memcmp(&hits[i], &expected[i], sizeof hits[i]) != 0 ? 1 : 0;
  if (wrong.total() + different > 0) {
    out.notes.push_back(fmt::format("instances {} seed {}: {} on {}, {} and {} wrong", cases::name_of(placing), seed,
                                    kernel_info(kernel).name, simd_target_name(target), wrong.total(), different));
  }
  out.rays += data.rays.size();
  out.by_oracle += data.rays.size();
  for (const std::uint8_t occluded : truth.occluded) out.occluded += occluded;
  out.ours.add(wrong);
  out.closest_wrong += different;
  out.answers.of(kernel, target) += 2 * data.rays.size();
  return {};
}

}  // namespace

Status check_instances(const StressSettings& settings, std::size_t rays, Counts& out) {
  const std::size_t scenes = std::max<std::size_t>(1, rays / kRaysPerScene);
  for (std::size_t i = 0; i < scenes; ++i) {
    const std::size_t target = i % simd_target_count();
    if (Status status = use_simd_target(simd_target_name(target)); !status) return status;
    const cases::Placing placing = cases::kPlacings[i % std::size(cases::kPlacings)];
    if (Status status = judge_scene(placing, settings.seed * 1'000'003 + i, i % kernel_count(), target, out); !status)
      return status;
  }
  return use_simd_target(nullptr);
}

}  // namespace umbrix::bench
