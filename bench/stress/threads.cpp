// SPDX-License-Identifier: Apache-2.0
//
// Threads share a scene whose side tables are empty at first and grow as rays want them. Whoever is first must not
// matter: the answers are hashed and compared, and the hash is that of the truth.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <thread>

#include "cases/meshes.h"
#include "stress/checks.h"
#include "stress/embree_errors.h"
#include "umbrix/umbrix.h"

namespace umbrix::bench {
namespace {

constexpr std::size_t kThreadCounts[] = {1, 2, 4, 8, 16, 32, 64};
constexpr const char* kKernels[] = {"auto", "linked", "wide", "beam"};
constexpr std::size_t kTile = 256;
constexpr std::size_t kWays = std::size(kKernels) + 1;  // and a frame tracer

std::uint64_t hash_of(const std::vector<std::uint8_t>& answers) {  // FNV-1a
  std::uint64_t hash = 0xCBF29CE484222325ull;
  for (const std::uint8_t answer : answers) hash = (hash ^ answer) * 0x100000001B3ull;
  return hash;
}

// body(begin, count) for tiles, from so many threads that take the next one each.
template <typename Body>
void from_threads(std::size_t threads, std::size_t count, const Body& body) {
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t begin; (begin = next.fetch_add(kTile)) < count;) body(begin, std::min(kTile, count - begin));
  };
  std::vector<std::thread> others;
  for (std::size_t i = 1; i < threads; ++i) others.emplace_back(work);
  work();
  for (std::thread& thread : others) thread.join();
}

cases::CaseData crowded_scene(std::uint64_t seed, std::size_t rays) {
  cases::Random random(seed);
  cases::CaseData data{cases::icosphere(4, 1, 0.1f, {0, 0, 0}, random).triangles, {}};
  const auto loose = cases::soup(15'000, 2, 0.1f, random);
  data.triangles.insert(data.triangles.end(), loose.begin(), loose.end());
  const cases::Float3 lights[] = {{0, 0, 0}, {2, 2, 2}, {0, 0, 9}};
  for (std::size_t i = 0; i < rays; ++i) {
    const cases::Float3 target = random.chance(0.2)
                                     ? cases::point_on(data.triangles[random.below(data.triangles.size())], random)
                                     : lights[random.below(3)];
    data.rays.push_back(cases::ray_to(random.in_cube(2), target, 0, 1));
  }
  return data;
}

using Answers = std::vector<std::uint8_t>;

Status ask_kernel(const char* kernel, std::size_t threads, const cases::CaseData& data, Answers& out) {
  Scene scene;
  if (Status status = judge::build(data.triangles, scene); !status) return status;
  if (Status status = judge::prepare(kernel, {}, scene); !status) return status;
  QueryOptions options;
  if (Status status = find_kernel(kernel, options.kernel); !status) return status;
  from_threads(threads, data.rays.size(), [&](std::size_t begin, std::size_t count) {
    scene.occluded({data.rays.data() + begin, count}, out.data() + begin, options);
  });
  return {};
}

// Two frames; the answers are those of the second, which knows what the first one found.
Status ask_tracer(std::size_t threads, const cases::CaseData& data, Answers& out) {
  Scene scene;
  FrameTracer tracer;
  if (Status status = judge::build(data.triangles, scene); !status) return status;
  if (Status status = tracer.start(scene); !status) return status;
  for (int frame = 0; frame < 2; ++frame) {
    FrameView view;
    view.frame = frame;
    if (Status status = tracer.begin_frame(view); !status) return status;
    from_threads(threads, data.rays.size(), [&](std::size_t begin, std::size_t count) {
      ShadowTile tile;
      tile.rays = {data.rays.data() + begin, count};
      tracer.occluded(tile, out.data() + begin);
    });
    tracer.end_frame();
  }
  return {};
}

}  // namespace

Status check_threads(const StressSettings& settings, std::size_t rays, Counts& out) {
  const std::size_t answers_each = std::max(rays / (kWays * std::size(kThreadCounts)), kTile);
  const cases::CaseData data = crowded_scene(settings.seed, answers_each);
  const Answers truth = judge::find_truth(data, {}).occluded;
  out.by_oracle += data.rays.size();
  const std::uint64_t right = hash_of(truth);
  for (const std::size_t threads : kThreadCounts) {
    for (std::size_t way = 0; way < kWays; ++way) {
      Answers answers(data.rays.size());
      const bool is_kernel = way < std::size(kKernels);
      const char* const name = is_kernel ? kKernels[way] : "frame tracer";
      if (Status status = is_kernel ? ask_kernel(name, threads, data, answers) : ask_tracer(threads, data, answers);
          !status) {
        return status;
      }
      out.rays += data.rays.size();
      out.ours.add(count_wrong(answers, truth));
      for (const std::uint8_t occluded : truth) out.occluded += occluded;
      if (is_kernel) {
        KernelId id;
        if (Status status = find_kernel(name, id); !status) return status;
        out.answers.of(static_cast<std::size_t>(id.index), 0) += answers.size();
      }
      if (hash_of(answers) == right) continue;
      ++out.different;
      out.notes.push_back(fmt::format("{} with {} threads: another hash", name, threads));
    }
  }
  return {};
}

}  // namespace umbrix::bench
