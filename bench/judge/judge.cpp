// SPDX-License-Identifier: Apache-2.0
#include "judge/judge.h"

#include <algorithm>
#include <cstring>
#include <mutex>
#include <numeric>

#include "judge/blocks.h"
#include "judge/host_mode.h"
#include "umbrix/kernel.h"

namespace umbrix::judge {
namespace {

// Ray/triangle tests that the kernel `brute` may spend on a block: it would take longer than all others together.
constexpr std::size_t kBruteTests = 300'000;

// What is asked, and where the answers go.
class Hearing {
 public:
  Hearing(const cases::CaseData& data, const Options& options, const Scene& scene, Result& out)
      : data_(data), options_(options), scene_(scene), out_(out) {}

  // Rays begin .. begin + count to one kernel under the current instruction set.
  void ask(KernelId kernel, std::size_t target, std::size_t begin, std::size_t count) {
    const char* const name = kernel_info(static_cast<std::size_t>(kernel.index)).name;
    const std::size_t triangles = std::max<std::size_t>(1, data_.triangles.size());
    const bool is_brute = std::strcmp(name, "brute") == 0;
    const std::size_t end = begin + (is_brute ? std::min(count, 1 + kBruteTests / triangles) : count);
    QueryOptions query;
    query.kernel = kernel;
    std::vector<std::uint8_t> occluded(end - begin);
    std::vector<Hit> hits(std::min(end, out_.truth.closest.size()) - std::min(begin, out_.truth.closest.size()));
    {
      const HostModeScope mode(options_.mode);
      scene_.occluded({data_.rays.data() + begin, occluded.size()}, occluded.data(), query);
      scene_.closest({data_.rays.data() + begin, hits.size()}, hits.data(), query);
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    const Question question{name, simd_target_name(target), Query::occluded};
    for (std::size_t i = 0; i < occluded.size(); ++i) {
      if (occluded[i] != out_.truth.occluded[begin + i]) out_.complaints.push_back({begin + i, question, occluded[i]});
    }
    for (std::size_t i = 0; i < hits.size(); ++i) {
      const std::uint32_t triangle = hits[i].valid() ? hits[i].primitive.triangle : Primitive::kNone;
      if (triangle != out_.truth.closest[begin + i]) {
        out_.complaints.push_back({begin + i, {name, simd_target_name(target), Query::closest}, 0});
      }
    }
    out_.answers.of(static_cast<std::size_t>(kernel.index), target) += occluded.size() + hits.size();
  }

 private:
  const cases::CaseData& data_;
  const Options& options_;
  const Scene& scene_;
  Result& out_;
  std::mutex mutex_;
};

Status build_in_mode(const cases::CaseData& data, const Options& options, const std::vector<KernelId>& kernels,
                     Scene& scene) {
  const HostModeScope mode(options.mode);
  if (Status status = build(data.triangles, scene); !status) return status;
  Training training;
  training.rays = {data.rays.data(), std::min(options.training_rays, data.rays.size())};
  for (const KernelId kernel : kernels) {
    if (Status status = scene.prepare(kernel, training); !status) return status;
  }
  return {};
}

Status find_kernels(const std::vector<std::string>& names, std::vector<KernelId>& out) {
  for (std::size_t i = 0; names.empty() && i < kernel_count(); ++i) out.push_back({static_cast<int>(i)});
  for (const std::string& name : names) {
    KernelId id;
    if (Status status = find_kernel(name.c_str(), id); !status) return status;
    out.push_back(id);
  }
  return {};
}

// Rays first .. last to the kernels under the current instruction set.
void ask_range(const std::vector<KernelId>& kernels, std::size_t per_ray, std::size_t target, std::size_t first,
               std::size_t last, Hearing& hearing) {
  for_each_block(last - first, [&](std::size_t begin, std::size_t count) {
    const std::size_t turn = begin / kBlock * per_ray;
    tbb::parallel_for(std::size_t{0}, per_ray, [&](std::size_t k) {
      hearing.ask(kernels[(turn + k) % kernels.size()], target, first + begin, count);
    });
  });
}

// Goes over the instruction sets: some rays are asked of all kernels on each, a part of the others on each.
Status ask_on_targets(const std::vector<KernelId>& kernels, const Options& options, std::size_t rays,
                      Hearing& hearing) {
  const std::size_t per_ray = options.kernels_per_ray == 0 ? kernels.size() : options.kernels_per_ray;
  const std::size_t on_each = std::min(rays, options.rays_on_each_target), targets = simd_target_count();
  for (std::size_t target = 0; target < targets; ++target) {
    if (Status status = use_simd_target(simd_target_name(target)); !status) return status;
    ask_range(kernels, kernels.size(), target, 0, on_each, hearing);
    const std::size_t rest = rays - on_each;
    ask_range(kernels, per_ray, target, on_each + rest * target / targets, on_each + rest * (target + 1) / targets,
              hearing);
  }
  return use_simd_target(nullptr);
}

}  // namespace

AnswerCounts::AnswerCounts() : counts_(kernel_count() * simd_target_count()) {}

void AnswerCounts::add(const AnswerCounts& other) {
  for (std::size_t i = 0; i < counts_.size(); ++i) counts_[i] += other.counts_[i];
}

std::uint64_t AnswerCounts::total() const { return std::accumulate(counts_.begin(), counts_.end(), std::uint64_t{0}); }

std::uint64_t& AnswerCounts::of(std::size_t kernel, std::size_t target) {
  return counts_[kernel * simd_target_count() + target];
}

std::uint64_t AnswerCounts::of(std::size_t kernel, std::size_t target) const {
  return counts_[kernel * simd_target_count() + target];
}

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
  out = Result();
  std::vector<KernelId> kernels;
  if (Status status = find_kernels(options.kernels, kernels); !status) return status;
  Scene scene;
  if (Status status = build_in_mode(data, options, kernels, scene); !status) return status;
  out.build = scene.build_stats();
  out.truth = find_truth(data, options.truth);
  Hearing hearing(data, options, scene, out);
  if (options.targets == Targets::all) return ask_on_targets(kernels, options, data.rays.size(), hearing);
  ask_range(kernels, options.kernels_per_ray == 0 ? kernels.size() : options.kernels_per_ray, options.current_target, 0,
            data.rays.size(), hearing);
  return {};
}

}  // namespace umbrix::judge
