// SPDX-License-Identifier: Apache-2.0
//
// Shadow rays per second. All peers answer the same rays in one process; in each round every peer runs once, so that a
// disturbance of the machine meets all of them. The medians over the rounds are compared, or where each round has a
// frame of its own, the sums: what is made in some frames for those that follow is paid for.
#include <fmt/core.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "command.h"
#include "embree/embree_scene.h"
#include "report.h"
#include "throughput/ask.h"
#include "throughput/first_frame.h"
#include "throughput/light_order.h"
#include "throughput/phases.h"
#include "umbrix/umbrix.h"
#include "workload/disputes.h"
#include "workload/geometry.h"
#include "workload/shadow_rays.h"

namespace umbrix::bench {
namespace {

struct Settings {
  std::vector<std::string> scenes;
  std::vector<std::string> kernels;
  std::string setup;
  std::string json;
  std::vector<std::string> phases{"first"};
  int size = 1024;
  int threads = 1;
  int rounds = 7;
  std::size_t light = 0;
  bool has_embree = true;
};

struct Peer {
  std::string name;
  Ask run;
  bool is_embree = false;
  bool is_sorted = false;                               ///< its host sorts the rays for it
  Cutting cutting = Cutting::none;                      ///< for several threads
  std::function<void()> begin = {}, end = {};           ///< of a frame, timed with it
  std::vector<std::vector<std::uint8_t>> answers = {};  ///< of each frame
  std::vector<double> seconds = {};
  std::uint64_t wrong = 0;
};

// Testing every triangle is only worth a row where that ends soon.
constexpr std::size_t kBruteTriangles = 2000;
constexpr const char* kReferenceEmbree = "embree:single:robust";

Status add_kernels(const Settings& settings, Scene& scene, std::size_t triangles, const std::vector<Ray>& rays,
                   std::vector<Peer>& peers) {
  Training training;
  training.rays = {rays.data(), rays.size()};
  std::vector<std::string> names = settings.kernels;
  if (names.empty()) {
    for (std::size_t i = 0; i < kernel_count(); ++i) {
      const std::string name = kernel_info(i).name;
      if (name != "brute" || triangles <= kBruteTriangles) names.push_back(name);
    }
  }
  for (const std::string& name : names) {
    QueryOptions options;
    options.executor = executor_for(settings.threads);
    if (Status status = find_kernel(name.c_str(), options.kernel); !status) return status;
    if (Status status = scene.prepare(options.kernel, training); !status) return status;
    peers.push_back(
        {"umbrix:" + name, [&scene, options](RaySpan part, std::uint8_t* out) { scene.occluded(part, out, options); }});
  }
  return {};
}

// What is learnt from frame to frame.
void add_frames(FrameTracer& tracer, int threads, std::vector<Peer>& peers) {
  const auto trace = [&tracer, threads](RaySpan rays, std::uint8_t* out) {
    ShadowTile tile;
    tile.executor = executor_for(threads);
    tile.rays = rays;
    tracer.occluded(tile, out);
  };
  Peer peer{"umbrix:frames", trace};
  peer.begin = [&tracer, frame = std::int64_t{0}]() mutable {
    FrameView view;
    view.frame = frame++;
    static_cast<void>(tracer.begin_frame(view));  // without memory it goes on as the first frame
  };
  peer.end = [&tracer] { tracer.end_frame(); };
  peers.push_back(std::move(peer));
}

void add_embree(const embree::EmbreeScene& scene, const std::string& suffix, bool is_shuffled,
                std::vector<Peer>& peers) {
  for (const embree::Mode mode : embree::modes()) {
    const Ask ask = [&scene, mode](RaySpan rays, std::uint8_t* out) { scene.occluded(rays, mode, out); };
    const std::string name = fmt::format("embree:{}:{}", embree::mode_name(mode), suffix);
    peers.push_back({name, ask, true, false, Cutting::blocks});
    if (!is_shuffled) continue;
    const auto orders = std::make_shared<tbb::enumerable_thread_specific<LightOrder>>();
    const Ask ask_sorted = [ask, orders](RaySpan rays, std::uint8_t* out) { orders->local().ask(rays, out, ask); };
    peers.push_back({name + ":sorted", ask_sorted, true, true, Cutting::parts});
  }
}

// The system may have taken memory back that was not read for a while: no peer is to pay for that.
void read_all(const std::vector<Ray>& rays) {
  volatile float sink = 0;
  for (const Ray& ray : rays) sink = ray.origin[0];
  static_cast<void>(sink);
}

// One frame.
double time_once(const Peer& peer, const std::vector<Ray>& rays, std::vector<std::uint8_t>& answers, int threads) {
  answers.resize(rays.size());
  tbb::task_arena arena(threads);
  const double start = seconds_of(threads);
  if (peer.begin) peer.begin();
  arena.execute([&] { ask_all(peer.run, rays, answers.data(), threads, peer.cutting); });
  if (peer.end) peer.end();
  return seconds_of(threads) - start;
}

// Whatever the peers do not agree on, exact arithmetic decides.
void judge(const workload::Geometry& geometry, const Phase& phase, std::vector<Peer>& peers) {
  for (std::size_t frame = 0; frame < phase.frames.size(); ++frame) {
    std::vector<const std::vector<std::uint8_t>*> answers;
    answers.reserve(peers.size());
    for (const Peer& peer : peers) answers.push_back(&peer.answers[frame]);
    const std::vector<std::uint64_t> wrong = workload::count_wrong(geometry, phase.frames[frame], answers);
    for (std::size_t i = 0; i < peers.size(); ++i) peers[i].wrong += wrong[i];
  }
}

// Of the median round, or of all frames together.
double rays_per_microsecond(const Peer& peer, const Phase& phase) {
  double rays = static_cast<double>(phase.frames[0].size()), seconds = median(peer.seconds);
  if (phase.frames.size() > 1) {
    rays = seconds = 0;
    for (const auto& frame : phase.frames) rays += static_cast<double>(frame.size());
    for (const double x : peer.seconds) seconds += x;
  }
  return seconds > 0 ? 1e-6 * rays / seconds : 0;
}

// Prints the table of a scene and a phase, and adds it to the report.
void report(const workload::Geometry& geometry, const Phase& phase, const Settings& settings,
            const std::vector<Peer>& peers, nlohmann::json& rows) {
  double best_embree = 0, best_sorted = 0, reference = 0;
  for (const Peer& peer : peers) {
    const double speed = rays_per_microsecond(peer, phase);
    double& best = peer.is_sorted ? best_sorted : best_embree;
    if (peer.is_embree) best = std::max(best, speed);
    if (peer.name == kReferenceEmbree) reference = speed;
  }
  const std::vector<std::uint8_t>& answers = peers[0].answers[0];
  const auto occluded = std::count(answers.begin(), answers.end(), std::uint8_t{1});
  const auto rays = static_cast<double>(phase.frames[0].size());
  const double share = rays > 0 ? static_cast<double>(occluded) / rays : 0;
  fmt::print("{}, {}: {} triangles, {} rays, {:.1f} % occluded\n", geometry.name, phase.name, geometry.triangle_count(),
             phase.frames[0].size(), 100 * share);
  fmt::print("  {:<40} {:>9} {:>8} {:>10} {:>12} {:>7}\n", "peer", "Mrays/s", "spread", "/ best E", "/ E single r",
             "wrong");
  const auto ratio = [](double speed, double other) { return other > 0 ? speed / other : 0; };
  for (const Peer& peer : peers) {
    const double speed = rays_per_microsecond(peer, phase);
    const auto [fastest, slowest] = std::minmax_element(peer.seconds.begin(), peer.seconds.end());
    const double spread = ratio(*slowest - *fastest, median(peer.seconds));
    fmt::print("  {:<40} {:>9.2f} {:>7.1f}% {:>10.3f} {:>12.3f} {:>7}\n", peer.name, speed, 100 * spread,
               ratio(speed, best_embree), ratio(speed, reference), peer.wrong);
    rows.push_back({{"scene", geometry.name},
                    {"phase", phase.name},
                    {"threads", settings.threads},
                    {"peer", peer.name},
                    {"rays", phase.frames[0].size()},
                    {"frames", phase.frames.size()},
                    {"mrays_per_s", speed},
                    {"seconds", peer.seconds},
                    {"spread", spread},
                    {"ratio_to_best_embree", ratio(speed, best_embree)},
                    {"ratio_to_best_sorted_embree", ratio(speed, best_sorted)},
                    {"ratio_to_embree_single_robust", ratio(speed, reference)},
                    {"wrong", peer.wrong}});
  }
}

struct EmbreeScenes {
  embree::EmbreeScene robust, fast, medium;

  Status build(const std::vector<MeshView>& views) {
    if (Status status = robust.build(views, {embree::Quality::high, true, 0}); !status) return status;
    if (Status status = fast.build(views, {embree::Quality::high, false, 0}); !status) return status;
    return medium.build(views, {embree::Quality::medium, false, 0});
  }
  void add(bool is_shuffled, std::vector<Peer>& peers) const {
    add_embree(robust, "robust", is_shuffled, peers);
    add_embree(fast, "fast", is_shuffled, peers);
    add_embree(medium, "fast:medium", is_shuffled, peers);
  }
};

Status measure_phase(const Settings& settings, const workload::Geometry& geometry, const Phase& phase, Scene& scene,
                     const EmbreeScenes& embree, nlohmann::json& rows, bool& any_wrong) {
  std::vector<Peer> peers;
  const std::vector<Ray>& first = phase.before.empty() ? phase.frames[0] : phase.before;
  if (Status status = add_kernels(settings, scene, geometry.triangle_count(), first, peers); !status) return status;
  FrameTracer tracer;
  if (Status status = tracer.start(scene); !status) return status;
  if (!phase.before.empty()) add_frames(tracer, settings.threads, peers);
  if (settings.has_embree) embree.add(phase.is_shuffled, peers);
  for (Peer& peer : peers) {
    peer.answers.resize(phase.frames.size());
    time_once(peer, first, peer.answers[0], settings.threads);  // warms up, and is not counted
  }
  for (std::size_t round = 0; round < static_cast<std::size_t>(settings.rounds); ++round) {
    const std::size_t frame = round % phase.frames.size();
    read_all(phase.frames[frame]);
    for (Peer& peer : peers)
      peer.seconds.push_back(time_once(peer, phase.frames[frame], peer.answers[frame], settings.threads));
  }
  judge(geometry, phase, peers);
  report(geometry, phase, settings, peers, rows);
  any_wrong = any_wrong || std::any_of(peers.begin(), peers.end(),
                                       [](const Peer& peer) { return !peer.is_embree && peer.wrong > 0; });
  return {};
}

Status measure(const Settings& settings, const std::string& path, nlohmann::json& rows, bool& any_wrong) {
  workload::Geometry geometry;
  if (Status status = workload::load_geometry(path, geometry); !status) return status;
  workload::Viewpoint viewpoint;
  if (Status status = workload::find_viewpoint(geometry, settings.setup, viewpoint); !status) return status;
  if (settings.light >= viewpoint.lights.size()) {
    return {StatusCode::invalid_argument,
            fmt::format("{}: no light {}; there are {}", path, settings.light, viewpoint.lights.size())};
  }

  const std::vector<MeshView> views = geometry.views();
  Scene scene;
  EmbreeScenes embree;
  if (Status status = workload::build_scene(views, {}, scene); !status) return status;
  if (Status status = embree.build(views); !status) return status;
  for (const std::string& name : settings.phases) {
    Phase phase;
    const bool builds = name == "build+first";
    if (Status status = make_phase(builds ? "first" : name, scene, geometry, viewpoint, settings.light, settings.size,
                                   settings.rounds, phase);
        !status)
      return status;
    if (phase.frames[0].empty()) continue;
    if (builds) {
      const FirstFrameSettings first{settings.threads, settings.rounds, settings.has_embree};
      if (Status status = measure_first_frame(geometry, phase.frames[0], first, rows, any_wrong); !status)
        return status;
      continue;
    }
    if (Status status = measure_phase(settings, geometry, phase, scene, embree, rows, any_wrong); !status)
      return status;
  }
  return {};
}

ExitCode run(const Settings& settings) {
  fmt::print("Umbrix {} ({}), Embree {}, {} thread(s), {} rounds; medians\n", version_string(), simd_target_name(0),
             embree::version(), settings.threads, settings.rounds);
  nlohmann::json rows = nlohmann::json::array();
  bool any_wrong = false;
  for (const std::string& path : settings.scenes) {
    if (const Status status = measure(settings, path, rows, any_wrong); !status) return fail(status);
  }
  const ExitCode written = write_json(settings.json, {{"embree", embree::version()},
                                                      {"simd_target", simd_target_name(0)},
                                                      {"threads", settings.threads},
                                                      {"size", settings.size},
                                                      {"rounds", settings.rounds},
                                                      {"light", settings.light},
                                                      {"rows", rows}});
  return written != kDone ? written : any_wrong ? kFailed : kDone;
}

}  // namespace

std::function<ExitCode()> throughput_command(CLI::App& app) {
  auto settings = std::make_shared<Settings>();
  app.add_option("scene", settings->scenes, "glTF files")->required();
  app.add_option("--setup", settings->setup, "Camera and lights from this file");
  app.add_option("--size", settings->size, "Primary rays in each direction")->check(CLI::Range(1, 1 << 14));
  app.add_option("--threads", settings->threads, "Threads; with more than one, wall time is measured")
      ->check(CLI::Range(1, 1024));
  app.add_option("--rounds", settings->rounds, "Measured runs of each peer")->check(CLI::Range(1, 1000));
  app.add_option("--light", settings->light, "Which light, counted from 0");
  app.add_option("--phase", settings->phases,
                 "first, next:D (a camera moved by D of the diagonal), shuffled, area; build+first: see README.md")
      ->delimiter(',');
  app.add_option("--kernel", settings->kernels, "Only these kernels")->delimiter(',');
  app.add_flag_callback(
      "--no-embree", [settings] { settings->has_embree = false; }, "Leave Embree out, to profile");
  app.add_option("--json", settings->json, "Write the rows to this file");
  return [settings] { return run(*settings); };
}

}  // namespace umbrix::bench
