// SPDX-License-Identifier: Apache-2.0
//
// Wrong answers and time on the same rays. Truth is the exact judge's answer for every ray, not only where peers
// differ. In each round every peer runs once, so that a disturbance of the machine meets all of them.
#include "error/ray_errors.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <memory>

#include "embree/embree_scene.h"
#include "error/embree_contestant.h"
#include "oracle/box_tree.h"
#include "table1/contestant.h"
#include "table1/moving_camera.h"
#include "workload/adversarial_rays.h"

namespace umbrix::bench {
namespace {

struct Peer {
  std::unique_ptr<Contestant> contestant;
  std::string name;
  std::string family;
};

/// What all sets of a scene are asked of.
struct Arena {
  Scene scene;
  embree::EmbreeScene robust, fast;
  std::unique_ptr<oracle::BoxTree> truth;
  std::vector<Peer> peers;
};

Peer named(std::unique_ptr<Contestant> kernel) {
  const std::string name = kernel->name();
  if (name == "auto") return {std::move(kernel), "frames:best", "frame tracer"};
  if (name == "paper") return {std::move(kernel), "frames:paper", "frame tracer"};
  return {std::move(kernel), "umbrix:" + name, "umbrix"};
}

Status set_up(const workload::Geometry& geometry, const RayErrorOptions& options, Arena& arena) {
  const std::vector<MeshView> views = geometry.views();
  if (Status status = workload::build_scene(views, {}, arena.scene); !status) return status;
  if (Status status = arena.robust.build(views, {embree::Quality::high, true, 0}); !status) return status;
  if (Status status = arena.fast.build(views, {embree::Quality::high, false, 0}); !status) return status;
  arena.truth = std::make_unique<oracle::BoxTree>(geometry.triangle_list());

  std::vector<std::unique_ptr<Contestant>> kernels;
  if (Status status = make_contestants(options.kernels, kernels); !status) return status;
  // Under the name "auto" that is the frame tracer; what one gets from a Scene by default is a peer of its own.
  KernelId by_default;
  if (Status status = find_kernel("auto", by_default); !status) return status;
  arena.peers.push_back({kernel_contestant("auto", by_default), "umbrix:auto", "umbrix"});
  for (auto& kernel : kernels) arena.peers.push_back(named(std::move(kernel)));
  for (const bool is_robust : {true, false}) {
    const std::string suffix = is_robust ? "robust" : "fast";
    for (auto& mode : embree_contestants(is_robust ? arena.robust : arena.fast, suffix)) {
      const std::string name = mode->name();
      arena.peers.push_back({std::move(mode), name, "embree " + suffix});
    }
  }
  return {};
}

/// Rays in the order given as tiles of 16x16 pixels.
workload::TiledRays in_tiles(std::vector<Ray> rays) {
  constexpr std::size_t kSide = 16, kTile = kSide * kSide, kTilesAcross = 64;
  workload::TiledRays tiled;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const std::size_t tile = i / kTile, within = i % kTile;
    if (within == 0) tiled.tile_starts.push_back(i);
    tiled.pixels.push_back({static_cast<std::uint16_t>(tile % kTilesAcross * kSide + within % kSide),
                            static_cast<std::uint16_t>(tile / kTilesAcross * kSide + within / kSide)});
  }
  tiled.tile_starts.push_back(rays.size());
  tiled.rays = std::move(rays);
  return tiled;
}

/// The exact answers, found on all cores.
std::vector<std::uint8_t> find_truth(const oracle::BoxTree& tree, const std::vector<Ray>& rays) {
  std::vector<std::uint8_t> truth(rays.size());
  tbb::parallel_for(std::size_t{0}, rays.size(), [&](std::size_t i) { truth[i] = tree.occluded(rays[i]) ? 1 : 0; });
  return truth;
}

void judge(const std::vector<std::uint8_t>& truth, const std::vector<std::uint8_t>& answers,
           const std::vector<float>& irradiance, PeerErrors& out) {
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (answers[i] == truth[i]) continue;
    ++(truth[i] != 0 ? out.leaks : out.false_shadows);
    if (!irradiance.empty()) out.wrong_flux += irradiance[i];
  }
}

/// Asks all peers about the last of the frames.
Status ask(Arena& arena, const Frames& frames, const Training& lights, int rounds, RayErrors& out) {
  const workload::TiledRays& rays = frames.back();
  const std::vector<std::uint8_t> truth = find_truth(*arena.truth, rays.rays);
  out.rays = rays.rays.size();
  for (std::size_t i = 0; i < truth.size(); ++i) {
    out.occluded += truth[i];
    if (truth[i] == 0 && !rays.irradiance.empty()) out.flux += rays.irradiance[i];
  }
  for (const Peer& peer : arena.peers) out.peers.push_back({peer.name, peer.family});
  for (int round = -1; round < rounds; ++round) {  // the first warms up, and is judged
    for (std::size_t i = 0; i < arena.peers.size(); ++i) {
      FrameResult result;
      if (Status status = arena.peers[i].contestant->run(arena.scene, frames, lights, false, result); !status)
        return status;
      if (round < 0)
        judge(truth, result.answers, rays.irradiance, out.peers[i]);
      else
        out.peers[i].seconds.push_back(result.seconds);
    }
  }
  return {};
}

Status ordinary(Arena& arena, const workload::Geometry& geometry, const io::Camera& camera, const io::Light& light,
                const RayErrorOptions& options, RayErrors& out) {
  const Frames frames = moving_camera_frames(arena.scene, geometry, camera, light, options.size, CameraMotion());
  float position[1][3];
  for (std::size_t k = 0; k < 3; ++k) position[0][k] = static_cast<float>(light.position[k]);
  Training training;
  if (light.type != io::LightType::directional) {
    training.lights = position;
    training.light_count = 1;
  }
  return ask(arena, frames, training, options.rounds, out);
}

Status adversarial(Arena& arena, const workload::Geometry& geometry, workload::Aim aim, const RayErrorOptions& options,
                   RayErrors& out) {
  // What is learned comes from other rays of the same kind.
  Frames frames;
  for (const std::uint64_t seed : {options.seed + 1, options.seed}) {
    std::vector<Ray> rays;
    if (Status status = workload::adversarial_rays(geometry, aim, options.adversarial, seed, rays); !status)
      return status;
    frames.push_back(in_tiles(std::move(rays)));
  }
  return ask(arena, frames, {}, options.rounds, out);
}

}  // namespace

RayErrors& RayErrors::operator+=(const RayErrors& other) {
  rays += other.rays;
  occluded += other.occluded;
  flux += other.flux;
  if (peers.empty()) {
    peers = other.peers;
    return *this;
  }
  for (std::size_t i = 0; i < other.peers.size(); ++i) {
    const PeerErrors& peer = other.peers[i];
    peers[i].leaks += peer.leaks;
    peers[i].false_shadows += peer.false_shadows;
    peers[i].wrong_flux += peer.wrong_flux;
    for (std::size_t round = 0; round < peer.seconds.size(); ++round) peers[i].seconds[round] += peer.seconds[round];
  }
  return *this;
}

Status measure_rays(const workload::Geometry& geometry, const workload::Viewpoint& viewpoint,
                    const std::vector<std::size_t>& lights, const RayErrorOptions& options,
                    std::vector<RayErrors>& out) {
  Arena arena;
  if (Status status = set_up(geometry, options, arena); !status) return status;
  RayErrors all_lights{"ordinary", ""};
  for (const std::size_t light : lights) {
    RayErrors part;
    if (Status status = ordinary(arena, geometry, viewpoint.camera, viewpoint.lights[light], options, part); !status)
      return status;
    all_lights += part;
  }
  out.push_back(std::move(all_lights));
  for (const workload::Aim aim : workload::kAims) {
    if (options.adversarial == 0) break;
    RayErrors part{"adversarial", workload::aim_name(aim)};
    if (Status status = adversarial(arena, geometry, aim, options, part); !status) return status;
    out.push_back(std::move(part));
  }
  return {};
}

}  // namespace umbrix::bench
