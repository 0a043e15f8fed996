// SPDX-License-Identifier: Apache-2.0
#include "judge/judge.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "oracle/brute_force.h"
#include "umbrix/kernel.h"

namespace umbrix::judge {
namespace {

constexpr std::size_t kBlock = 1024;

template <typename Body>
void for_each_block(std::size_t count, const Body& body) {
  tbb::parallel_for(std::size_t{0}, (count + kBlock - 1) / kBlock, [&](std::size_t block) {
    const std::size_t begin = block * kBlock;
    body(begin, std::min(kBlock, count - begin));
  });
}

struct Truth {
  std::vector<std::uint8_t> occluded;
  std::vector<std::uint32_t> closest;  // the triangle, or Primitive::kNone
};

Truth find_truth(const cases::CaseData& data, std::size_t closest_rays) {
  const oracle::BruteForce oracle(data.triangles);
  Truth truth{oracle.occluded(data.rays), std::vector<std::uint32_t>(closest_rays, Primitive::kNone)};
  tbb::parallel_for(std::size_t{0}, closest_rays, [&](std::size_t i) {
    if (const auto hit = oracle.closest(data.rays[i])) truth.closest[i] = hit->triangle;
  });
  return truth;
}

// Asks one kernel everything under the current instruction set.
void ask(const Scene& scene, const cases::CaseData& data, const Truth& truth, const std::string& kernel,
         const std::string& target, const QueryOptions& options, Result& out) {
  std::vector<std::uint8_t> occluded(data.rays.size());
  for_each_block(data.rays.size(), [&](std::size_t begin, std::size_t count) {
    scene.occluded({data.rays.data() + begin, count}, occluded.data() + begin, options);
  });
  std::vector<Hit> hits(truth.closest.size());
  for_each_block(hits.size(), [&](std::size_t begin, std::size_t count) {
    scene.closest({data.rays.data() + begin, count}, hits.data() + begin, options);
  });
  for (std::size_t i = 0; i < occluded.size(); ++i) {
    if (occluded[i] != truth.occluded[i]) out.complaints.push_back({i, {kernel, target, Query::occluded}});
  }
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const std::uint32_t triangle = hits[i].valid() ? hits[i].primitive.triangle : Primitive::kNone;
    if (triangle != truth.closest[i]) out.complaints.push_back({i, {kernel, target, Query::closest}});
  }
  out.answers += occluded.size() + hits.size();
}

bool is_among(const std::vector<std::string>& kernels, const std::string& kernel) {
  return kernels.empty() || std::find(kernels.begin(), kernels.end(), kernel) != kernels.end();
}

}  // namespace

MeshView mesh_of(const std::vector<oracle::Triangle>& triangles) {
  MeshView mesh;
  mesh.vertices = triangles.empty() ? nullptr : triangles[0].v[0];
  mesh.vertex_count = 3 * triangles.size();
  mesh.triangle_count = triangles.size();
  return mesh;
}

Status build(const std::vector<oracle::Triangle>& triangles, Scene& out) {
  Scene scene;
  if (!triangles.empty()) {
    if (Status status = scene.add(mesh_of(triangles)); !status) return status;
  }
  if (Status status = scene.commit(); !status) return status;
  out = std::move(scene);
  return {};
}

Status prepare(const std::string& kernel, const std::vector<Ray>& rays, Scene& scene) {
  KernelId id;
  if (Status status = find_kernel(kernel.c_str(), id); !status) return status;
  Training training;
  training.rays = {rays.data(), rays.size()};
  return scene.prepare(id, training);
}

Status judge(const cases::CaseData& data, const Options& options, Result& out) {
  out = {};
  Scene scene;
  if (Status status = build(data.triangles, scene); !status) return status;
  std::vector<std::string> kernels = options.kernels;
  for (std::size_t i = 0; kernels.size() < kernel_count() && options.kernels.empty(); ++i) {
    kernels.emplace_back(kernel_info(i).name);
  }
  for (const std::string& kernel : kernels) {
    if (Status status = prepare(kernel, data.rays, scene); !status) return status;
  }
  Truth truth = find_truth(data, std::min(options.closest_rays, data.rays.size()));
  const std::size_t targets = options.all_targets ? simd_target_count() : 1;
  for (std::size_t target = 0; target < targets; ++target) {
    if (Status status = use_simd_target(simd_target_name(target)); !status) return status;
    for (const std::string& kernel : kernels) {
      if (target > 0 && !is_among(options.on_all_targets, kernel)) continue;
      QueryOptions query;
      if (Status status = find_kernel(kernel.c_str(), query.kernel); !status) return status;
      ask(scene, data, truth, kernel, simd_target_name(target), query, out);
    }
  }
  out.occluded = std::move(truth.occluded);
  return use_simd_target(nullptr);
}

}  // namespace umbrix::judge
