// SPDX-License-Identifier: Apache-2.0
//
// Shadow rays per second. All peers answer the same rays in one process; in each round every peer runs once, so that a
// disturbance of the machine meets all of them, and the medians over the rounds are compared.
#include <fmt/core.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "command.h"
#include "embree/embree_scene.h"
#include "report.h"
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
  int size = 1024;
  int threads = 1;
  int rounds = 7;
  std::size_t light = 0;
};

struct Peer {
  std::string name;
  std::function<void(RaySpan, std::uint8_t*)> run;
  bool is_embree = false;
  std::vector<std::uint8_t> answers = {};
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
    if (Status status = find_kernel(name.c_str(), options.kernel); !status) return status;
    if (Status status = scene.prepare(options.kernel, training); !status) return status;
    peers.push_back(
        {"umbrix:" + name, [&scene, options](RaySpan part, std::uint8_t* out) { scene.occluded(part, out, options); }});
  }
  return {};
}

void add_embree(const embree::EmbreeScene& scene, const std::string& suffix, std::vector<Peer>& peers) {
  for (const embree::Mode mode : embree::modes()) {
    peers.push_back({fmt::format("embree:{}:{}", embree::mode_name(mode), suffix),
                     [&scene, mode](RaySpan rays, std::uint8_t* out) { scene.occluded(rays, mode, out); }, true});
  }
}

// One run over all rays: processor time of this thread, or with several threads the wall time.
double time_once(const Peer& peer, const std::vector<Ray>& rays, std::uint8_t* out, int threads) {
  if (threads == 1) {
    const double start = thread_seconds();
    peer.run({rays.data(), rays.size()}, out);
    return thread_seconds() - start;
  }
  constexpr std::size_t kBlock = 4096;
  tbb::task_arena arena(threads);
  const double start = wall_seconds();
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, (rays.size() + kBlock - 1) / kBlock, [&](std::size_t block) {
      const std::size_t begin = block * kBlock;
      peer.run({rays.data() + begin, std::min(kBlock, rays.size() - begin)}, out + begin);
    });
  });
  return wall_seconds() - start;
}

// Whatever the peers do not agree on, exact arithmetic decides.
void judge(const workload::Geometry& geometry, const std::vector<Ray>& rays, std::vector<Peer>& peers) {
  std::vector<const std::vector<std::uint8_t>*> answers;
  for (const Peer& peer : peers) answers.push_back(&peer.answers);
  const std::vector<std::uint64_t> wrong = workload::count_wrong(geometry, rays, answers);
  for (std::size_t i = 0; i < peers.size(); ++i) peers[i].wrong = wrong[i];
}

double rays_per_microsecond(const Peer& peer, std::size_t rays) {
  const double seconds = median(peer.seconds);
  return seconds > 0 ? 1e-6 * static_cast<double>(rays) / seconds : 0;
}

// Prints the scene's table and adds it to the report.
void report(const workload::Geometry& geometry, const std::vector<Ray>& rays, const std::vector<Peer>& peers,
            nlohmann::json& rows) {
  double best_embree = 0, reference = 0;
  for (const Peer& peer : peers) {
    const double speed = rays_per_microsecond(peer, rays.size());
    if (peer.is_embree) best_embree = std::max(best_embree, speed);
    if (peer.name == kReferenceEmbree) reference = speed;
  }
  const auto occluded = std::count(peers[0].answers.begin(), peers[0].answers.end(), std::uint8_t{1});
  fmt::print("{}: {} triangles, {} rays, {:.1f} % occluded\n", geometry.name, geometry.triangle_count(), rays.size(),
             rays.empty() ? 0.0 : 100.0 * static_cast<double>(occluded) / static_cast<double>(rays.size()));
  fmt::print("  {:<32} {:>9} {:>8} {:>12} {:>12} {:>7}\n", "peer", "Mrays/s", "spread", "/ best E", "/ E single r",
             "wrong");
  for (const Peer& peer : peers) {
    const double speed = rays_per_microsecond(peer, rays.size());
    const auto [fastest, slowest] = std::minmax_element(peer.seconds.begin(), peer.seconds.end());
    const double middle = median(peer.seconds);
    const double spread = middle > 0 ? (*slowest - *fastest) / middle : 0;
    const double to_best = best_embree > 0 ? speed / best_embree : 0;
    const double to_reference = reference > 0 ? speed / reference : 0;
    fmt::print("  {:<32} {:>9.2f} {:>7.1f}% {:>12.3f} {:>12.3f} {:>7}\n", peer.name, speed, 100 * spread, to_best,
               to_reference, peer.wrong);
    rows.push_back({{"scene", geometry.name},
                    {"peer", peer.name},
                    {"rays", rays.size()},
                    {"mrays_per_s", speed},
                    {"spread", spread},
                    {"ratio_to_best_embree", to_best},
                    {"ratio_to_embree_single_robust", to_reference},
                    {"wrong", peer.wrong}});
  }
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
  embree::EmbreeScene robust, fast;
  if (Status status = workload::build_scene(views, {}, scene); !status) return status;
  if (Status status = robust.build(views, {embree::Quality::high, true, 0}); !status) return status;
  if (Status status = fast.build(views, {embree::Quality::high, false, 0}); !status) return status;
  const std::vector<Ray> rays =
      workload::shadow_rays(scene, geometry, viewpoint.camera, viewpoint.lights[settings.light], settings.size);

  std::vector<Peer> peers;
  if (Status status = add_kernels(settings, scene, geometry.triangle_count(), rays, peers); !status) return status;
  if (!getenv("NOE")) add_embree(robust, "robust", peers);
  if (!getenv("NOE")) add_embree(fast, "fast", peers);
  for (Peer& peer : peers) {
    peer.answers.resize(rays.size());
    time_once(peer, rays, peer.answers.data(), settings.threads);  // warms up, and is not counted
  }
  for (int round = 0; round < settings.rounds; ++round) {
    for (Peer& peer : peers) {
      peer.seconds.push_back(time_once(peer, rays, peer.answers.data(), settings.threads));
    }
  }
  judge(geometry, rays, peers);
  report(geometry, rays, peers, rows);
  any_wrong = any_wrong || std::any_of(peers.begin(), peers.end(),
                                       [](const Peer& peer) { return !peer.is_embree && peer.wrong > 0; });
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
  app.add_option("--kernel", settings->kernels, "Only these kernels")->delimiter(',');
  app.add_option("--json", settings->json, "Write the rows to this file");
  return [settings] { return run(*settings); };
}

}  // namespace umbrix::bench
