// SPDX-License-Identifier: Apache-2.0
#include "table1/contestant.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

namespace umbrix::bench {
namespace {

/// A kernel of the table. It is prepared from the frame before the last, and traces that one first: what it makes as it
/// goes is there then.
class KernelContestant : public Contestant {
 public:
  KernelContestant(std::string name, KernelId kernel) : name_(std::move(name)), kernel_(kernel) {}
  const std::string& name() const override { return name_; }

  Status run(Scene& scene, const Frames& frames, const Training& lights, bool count, FrameResult& out) override {
    out = FrameResult();
    QueryOptions options;
    options.kernel = kernel_;
    Training training = lights;
    const workload::TiledRays& before = frames[frames.size() > 1 ? frames.size() - 2 : 0];
    training.rays = {before.rays.data(), before.rays.size()};
    training.executor = &one_thread();
    PrepareStats stats;
    if (Status status = scene.prepare(kernel_, training, &stats); !status) return status;
    out.precompute_seconds = stats.seconds;
    if (frames.size() > 1 && kernel_info(static_cast<std::size_t>(kernel_.index)).needs_preparation) {
      trace_tiles(before, out.answers, [&](std::size_t tile, std::uint8_t* answers) {
        scene.occluded(tile_rays(before, tile), answers, options);
      });
    }
    const workload::TiledRays& last = frames.back();
    out.seconds = trace_tiles(last, out.answers, [&](std::size_t tile, std::uint8_t* answers) {
      if (count)
        scene.occluded(tile_rays(last, tile), answers, out.counts, options);
      else
        scene.occluded(tile_rays(last, tile), answers, options);
    });
    out.memory_bytes = scene.prepared_bytes(kernel_);
    return {};
  }

 private:
  std::string name_;
  KernelId kernel_;
};

class FrameContestant : public Contestant {
 public:
  FrameContestant(std::string name, const FrameOptions& options) : name_(std::move(name)), options_(options) {
    options_.executor = &one_thread();
  }
  const std::string& name() const override { return name_; }

  Status run(Scene& scene, const Frames& frames, const Training& lights, bool count, FrameResult& out) override {
    out = FrameResult();
    FrameOptions options = options_;
    options.count_work = count;
    FrameTracer tracer;
    const double start = thread_seconds();
    if (Status status = tracer.start(scene, options); !status) return status;
    const double start_seconds = thread_seconds() - start;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const workload::TiledRays& frame = frames[i];
      FrameView view;
      view.frame = static_cast<std::int64_t>(i);
      view.lights = lights.lights;
      view.light_count = lights.light_count;
      if (Status status = tracer.begin_frame(view); !status) return status;
      out.seconds = trace_tiles(frame, out.answers, [&](std::size_t number, std::uint8_t* answers) {
        ShadowTile tile;
        tile.rays = tile_rays(frame, number);
        tile.pixels = frame.pixels.data() + frame.tile_starts[number];
        tracer.occluded(tile, answers);
      });
      out.frame = tracer.end_frame();
    }
    out.counts = out.frame.counts;
    out.precompute_seconds = start_seconds + out.frame.precompute_seconds;
    out.memory_bytes = out.frame.bytes;
    return {};
  }

 private:
  std::string name_;
  FrameOptions options_;
};

FrameOptions cached_options() {
  FrameOptions options;
  options.method = FrameMethod::cached;
  return options;
}

FrameOptions paper_options() {
  FrameOptions options;
  options.method = FrameMethod::paper;
  options.key = PredictorKey::screen;
  options.rule = PredictorRule::sample;
  options.links = LinkMode::reached;
  options.index = IndexMode::paper;
  return options;
}

bool is_wanted(const std::string& name, const std::vector<std::string>& wanted) {
  for (const std::string& want : wanted) {
    if (want == "all" || want == name || name.rfind(want + "-", 0) == 0) return true;
  }
  return false;
}

}  // namespace

RaySpan tile_rays(const workload::TiledRays& frame, std::size_t tile) {
  const std::size_t begin = frame.tile_starts[tile];
  return {frame.rays.data() + begin, frame.tile_starts[tile + 1] - begin};
}

const Executor& one_thread() {
  static const Executor executor = {[](void*, std::size_t count, void (*body)(void*, std::size_t), void* data) {
                                      for (std::size_t i = 0; i < count; ++i) body(data, i);
                                    },
                                    nullptr};
  return executor;
}

std::unique_ptr<Contestant> kernel_contestant(std::string name, KernelId kernel) {
  return std::make_unique<KernelContestant>(std::move(name), kernel);
}

std::unique_ptr<Contestant> frame_contestant(std::string name, const FrameOptions& options) {
  return std::make_unique<FrameContestant>(std::move(name), options);
}

Status make_contestants(const std::vector<std::string>& names, std::vector<std::unique_ptr<Contestant>>& out) {
  // The table's own "auto" remembers nothing from frame to frame: the frame tracer stands for it here.
  std::vector<std::unique_ptr<Contestant>> known;
  for (std::size_t i = 0; i < kernel_count(); ++i) {
    const std::string name = kernel_info(i).name;
    if (name != "auto" && name != "brute") known.push_back(kernel_contestant(name, KernelId{static_cast<int>(i)}));
  }
  known.push_back(frame_contestant("paper", paper_options()));
  known.push_back(frame_contestant("cached", cached_options()));
  known.push_back(frame_contestant("auto", FrameOptions()));
  std::string list;
  for (const auto& contestant : known) list += (list.empty() ? "" : ", ") + contestant->name();
  for (const std::string& name : names) {
    const bool found = std::any_of(known.begin(), known.end(),
                                   [&](const auto& contestant) { return is_wanted(contestant->name(), {name}); });
    if (!found)
      return {StatusCode::invalid_argument, fmt::format("there is no kernel '{}'; there are: all, {}", name, list)};
  }
  out.clear();
  for (auto& contestant : known) {
    // The first is what the others are compared with.
    if (contestant->name() == "standard" || is_wanted(contestant->name(), names)) out.push_back(std::move(contestant));
  }
  return {};
}

}  // namespace umbrix::bench
