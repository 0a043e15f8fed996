// SPDX-License-Identifier: Apache-2.0
#include "throughput/first_frame.h"

#include <fmt/core.h>
#include <malloc.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>

#include "embree/embree_scene.h"
#include "report.h"
#include "throughput/ask.h"
#include "umbrix/umbrix.h"
#include "workload/disputes.h"

namespace umbrix::bench {
namespace {

/// How much more memory the process has had at once since it was made, as Linux counts its pages: builders with
/// allocators of their own are measured alike.
class MemoryPeak {
 public:
  MemoryPeak() {
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << "5";  // the peak is what is held now
    before_ = read("VmRSS:");
  }
  double megabytes() const { return (read("VmHWM:") - before_) * 1024e-6; }

 private:
  static double read(const std::string& key) {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
      if (word == key && status >> word) return std::atof(word.c_str());
    return 0;
  }

  double before_;
};

struct Contestant {
  std::vector<double> build = {}, megabytes = {};
  std::vector<std::vector<double>> frames = {};  ///< by mode
  std::vector<std::uint8_t> answers = {};

  double frame() const {
    double least = 0;
    for (std::size_t mode = 0; mode < frames.size(); ++mode)
      least = mode == 0 ? median(frames[0]) : std::min(least, median(frames[mode]));
    return least;
  }
  double all() const { return median(build) + frame(); }
};

Status run_umbrix(const std::vector<MeshView>& views, const std::vector<Ray>& rays, int threads, Contestant& out) {
  const MemoryPeak memory;
  Scene scene;
  double start = seconds_of(threads);
  if (Status status = workload::build_scene(views, {}, scene); !status) return status;
  out.build.push_back(seconds_of(threads) - start);
  out.megabytes.push_back(memory.megabytes());
  start = seconds_of(threads);
  QueryOptions options;
  options.executor = executor_for(threads);
  scene.occluded({rays.data(), rays.size()}, out.answers.data(), options);
  out.frames[0].push_back(seconds_of(threads) - start);
  return {};
}

Status run_embree(const std::vector<MeshView>& views, const std::vector<Ray>& rays, int threads, Contestant& out) {
  const MemoryPeak memory;
  embree::EmbreeScene scene;
  if (Status status = scene.build(views, {embree::Quality::medium, false, threads}); !status) return status;
  out.build.push_back(threads == 1 ? scene.commit_thread_seconds() : scene.commit_seconds());
  out.megabytes.push_back(memory.megabytes());
  for (std::size_t mode = 0; mode < out.frames.size(); ++mode) {
    const double start = seconds_of(threads);
    ask_all([&](RaySpan part, std::uint8_t* answers) { scene.occluded(part, embree::modes()[mode], answers); }, rays,
            out.answers.data(), threads, Cutting::blocks);
    out.frames[mode].push_back(seconds_of(threads) - start);
  }
  return {};
}

}  // namespace

Status measure_first_frame(const workload::Geometry& geometry, const std::vector<Ray>& rays,
                           const FirstFrameSettings& settings, nlohmann::json& rows, bool& any_wrong) {
  const std::vector<MeshView> views = geometry.views();
  Contestant ours, theirs;
  ours.frames.resize(1);
  ours.answers.resize(rays.size());
  theirs.frames.resize(embree::modes().size());
  theirs.answers.resize(rays.size());
  tbb::task_arena arena(settings.threads);
  for (int round = 0; round < settings.rounds; ++round) {
    Status status;
    arena.execute([&] { status = run_umbrix(views, rays, settings.threads, ours); });
    if (status && settings.has_embree)
      arena.execute([&] { status = run_embree(views, rays, settings.threads, theirs); });
    if (!status) return status;
  }
  std::vector<const std::vector<std::uint8_t>*> answers = {&ours.answers};
  if (settings.has_embree) answers.push_back(&theirs.answers);
  const std::vector<std::uint64_t> wrong = workload::count_wrong(geometry, rays, answers);
  any_wrong = any_wrong || wrong[0] > 0;

  fmt::print("{}, build+first: {} triangles, {} rays\n", geometry.name, geometry.triangle_count(), rays.size());
  fmt::print("  {:<16} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>7}\n", "peer", "build ms", "frame ms", "sum ms", "/ E",
             "peak MB", "/ E", "wrong");
  const auto add_row = [&](const char* peer, const Contestant& c, std::uint64_t wrong_answers) {
    const double megabytes = median(c.megabytes);
    const double time_ratio = settings.has_embree ? c.all() / theirs.all() : 0;
    const double memory_ratio = settings.has_embree ? megabytes / median(theirs.megabytes) : 0;
    fmt::print("  {:<16} {:>9.2f} {:>9.2f} {:>9.2f} {:>9.3f} {:>9.1f} {:>9.3f} {:>7}\n", peer, 1e3 * median(c.build),
               1e3 * c.frame(), 1e3 * c.all(), time_ratio, megabytes, memory_ratio, wrong_answers);
    rows.push_back({{"scene", geometry.name},
                    {"phase", "build+first"},
                    {"threads", settings.threads},
                    {"peer", peer},
                    {"rays", rays.size()},
                    {"seconds_build", median(c.build)},
                    {"seconds_frame", c.frame()},
                    {"seconds", c.all()},
                    {"seconds_ratio_to_embree", time_ratio},
                    {"peak_bytes", 1e6 * megabytes},
                    {"peak_ratio_to_embree", memory_ratio},
                    {"wrong", wrong_answers}});
  };
  add_row("umbrix", ours, wrong[0]);
  if (settings.has_embree) add_row("embree:medium", theirs, wrong[1]);
  std::fflush(stdout);
  return {};
}

}  // namespace umbrix::bench
