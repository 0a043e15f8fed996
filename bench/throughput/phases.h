// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "umbrix/scene.h"
#include "workload/shadow_rays.h"

namespace umbrix::bench {

/// Rays of frames, in the order in which they are asked.
struct Phase {
  std::string name;                      ///< "first", "next:0.01", "shuffled" or "area"
  std::vector<std::vector<Ray>> frames;  ///< one for each round, or one for all
  std::vector<Ray> before;               ///< of the frame before, for "next"
  bool is_shuffled = false;
};

/// "first": the camera's rays to the light. "next:D": frames of a camera that moves to its right by D of the scene's
/// diagonal from each to the next, as many as there are rounds, the first of which follows a frame that is not timed.
/// "shuffled": the first frame's in random order. "area": a quarter of the size each way, 16 rays from a point to a
/// sphere around the light, whose diameter is 1/40 of the diagonal, stratified. invalid_argument: another name.
Status make_phase(const std::string& name, const Scene& scene, const workload::Geometry& geometry,
                  const workload::Viewpoint& viewpoint, std::size_t light, int size, int rounds, Phase& out);

}  // namespace umbrix::bench
