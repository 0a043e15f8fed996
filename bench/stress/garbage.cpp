// SPDX-License-Identifier: Apache-2.0
//
// After build_garbage_geom in Embree's tests: coordinates are any 32 bits, and one index in 32 of some meshes is too.
// Beyond not crashing, a mesh must be refused exactly if an index leads nowhere, and what was taken be answered right.
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstring>

#include "cases/meshes.h"
#include "stress/checks.h"
#include "stress/embree_errors.h"
#include "umbrix/umbrix.h"

namespace umbrix::bench {
namespace {

constexpr std::size_t kMeshes = 20;
constexpr std::size_t kMostTriangles = 256;
constexpr std::size_t kRaysPerScene = 100;
constexpr std::size_t kScenesPerTarget = 16;

float any_float(cases::Random& random) {
  const auto bits = static_cast<std::uint32_t>(random.bits());
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

struct GarbageMesh {
  std::vector<float> vertices;
  std::vector<std::uint32_t> indices;

  std::size_t vertex_count() const { return vertices.size() / 3; }
  bool is_valid() const {
    return std::all_of(indices.begin(), indices.end(), [&](std::uint32_t i) { return i < vertex_count(); });
  }
  MeshView view() const {
    MeshView mesh;
    mesh.vertices = vertices.data();
    mesh.vertex_count = vertex_count();
    mesh.indices = indices.data();
    mesh.triangle_count = indices.size() / 3;
    return mesh;
  }
};

GarbageMesh any_mesh(cases::Random& random) {
  GarbageMesh mesh;
  const std::size_t triangles = random.below(kMostTriangles);
  const bool has_bad_indices = random.chance(0.3);
  for (std::size_t i = 0; i < 9 * triangles; ++i) mesh.vertices.push_back(any_float(random));
  for (std::size_t i = 0; i < 3 * triangles; ++i) {
    const bool is_bad = has_bad_indices && random.below(32) == 0;
    mesh.indices.push_back(static_cast<std::uint32_t>(is_bad ? random.bits() : random.below(3 * triangles)));
  }
  return mesh;
}

std::vector<Ray> any_rays(const std::vector<oracle::Triangle>& triangles, cases::Random& random) {
  std::vector<Ray> rays;
  while (rays.size() < kRaysPerScene) {
    Ray ray = {{any_float(random), any_float(random), any_float(random)},
               any_float(random),
               {any_float(random), any_float(random), any_float(random)},
               any_float(random)};
    if (!triangles.empty() && random.chance(0.7)) {
      const cases::Float3 target = cases::point_on(triangles[random.below(triangles.size())], random);
      ray = cases::ray_to({ray.origin[0], ray.origin[1], ray.origin[2]}, target, 0, random.uniform(0.5f, 4));
    }
    rays.push_back(ray);
  }
  return rays;
}

Status judge_scene(std::uint64_t seed, std::size_t target, Counts& out) {
  cases::Random random(seed);
  cases::CaseData data;
  Scene scene;
  for (std::size_t m = 0; m < kMeshes; ++m) {
    const GarbageMesh mesh = any_mesh(random);
    const Status added = scene.add(mesh.view());
    if (added.ok() != mesh.is_valid()) {
      ++out.different;
      out.notes.push_back(fmt::format("garbage seed {} mesh {}: taken {}, valid {}", seed, m, added.ok(), !added.ok()));
    }
    if (!added.ok()) continue;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      oracle::Triangle& t = data.triangles.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) std::copy_n(&mesh.vertices[3 * mesh.indices[i + k]], 3, t.v[k]);
    }
  }
  if (Status status = scene.commit(); !status) return status;
  data.rays = any_rays(data.triangles, random);
  const judge::Truth truth = judge::find_truth(data, {});
  WrongRays worst;
  for (std::size_t k = 0; k < kernel_count(); ++k) {
    QueryOptions options;
    options.kernel = {static_cast<int>(k)};
    Training training;
    training.rays = {data.rays.data(), data.rays.size()};
    if (Status status = scene.prepare(options.kernel, training); !status) return status;
    std::vector<std::uint8_t> answers(data.rays.size());
    scene.occluded({data.rays.data(), data.rays.size()}, answers.data(), options);
    const WrongRays wrong = count_wrong(answers, truth.occluded);
    if (wrong.total() > 0) out.notes.push_back(fmt::format("garbage seed {}: {}", seed, kernel_info(k).name));
    worst = wrong.total() > worst.total() ? wrong : worst;
    out.answers.of(k, target) += answers.size();
  }
  out.rays += data.rays.size();
  out.by_oracle += data.rays.size();
  for (const std::uint8_t occluded : truth.occluded) out.occluded += occluded;
  out.ours.add(worst);
  out.slowest_build = std::max(out.slowest_build, scene.build_stats().seconds);
  out.largest_scene = std::max(out.largest_scene, scene.build_stats().bytes);
  return count_embree_errors(data, truth.occluded, out);
}

}  // namespace

Status check_garbage(const StressSettings& settings, std::size_t rays, Counts& out) {
  const std::size_t scenes = std::max<std::size_t>(1, rays / kRaysPerScene);
  for (std::size_t begin = 0; begin < scenes; begin += kScenesPerTarget) {
    const std::size_t target = begin / kScenesPerTarget % simd_target_count();
    if (Status status = use_simd_target(simd_target_name(target)); !status) return status;
    const std::size_t count = std::min(kScenesPerTarget, scenes - begin);
    std::vector<Counts> counts(count);
    std::vector<Status> statuses(count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
      statuses[i] = judge_scene(settings.seed * 1'000'003 + begin + i, target, counts[i]);
    });
    for (std::size_t i = 0; i < count; ++i) {
      if (!statuses[i]) return statuses[i];
      out.add(counts[i]);
    }
  }
  return use_simd_target(nullptr);
}

}  // namespace umbrix::bench
