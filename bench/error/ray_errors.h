// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "umbrix/status.h"
#include "workload/geometry.h"
#include "workload/shadow_rays.h"

namespace umbrix::bench {

struct RayErrorOptions {
  std::vector<std::string> kernels = {"all"};  ///< as make_contestants takes them
  int size = 512;                              ///< primary rays in each direction
  std::size_t adversarial = 100'000;           ///< rays of each aim; 0: none
  std::uint64_t seed = 1;                      ///< of the adversarial rays
  int rounds = 5;
};

/// What one peer made of some rays.
struct PeerErrors {
  std::string peer;                  ///< "umbrix:KERNEL", "frames:best", "embree:MODE:robust", ...
  std::string family;                ///< "umbrix", "frame tracer", "embree robust" or "embree fast"
  std::uint64_t leaks = 0;           ///< occluded rays that it let through
  std::uint64_t false_shadows = 0;   ///< unoccluded rays that it stopped
  double wrong_flux = 0;             ///< the irradiance that wrong answers add or take
  std::vector<double> seconds = {};  ///< of each round, processor time of one thread
};

/// Rays of one kind, all judged by exact arithmetic.
struct RayErrors {
  std::string kind;  ///< "ordinary" or "adversarial"
  std::string aim;   ///< what adversarial rays are aimed at; empty for ordinary ones
  std::uint64_t rays = 0;
  std::uint64_t occluded = 0;          ///< in truth
  double flux = 0;                     ///< the irradiance of rays that are not; 0 for adversarial ones
  std::vector<PeerErrors> peers = {};  ///< the same ones in the same order in each set of a scene

  /// Takes rays of the same peers in.
  RayErrors& operator+=(const RayErrors& other);
};

/// Asks every kernel, the frame tracers and Embree in all modes: shadow rays of the chosen lights (one set, summed over
/// them), then adversarial rays, a set for each aim.
Status measure_rays(const workload::Geometry& geometry, const workload::Viewpoint& viewpoint,
                    const std::vector<std::size_t>& lights, const RayErrorOptions& options,
                    std::vector<RayErrors>& out);

}  // namespace umbrix::bench
