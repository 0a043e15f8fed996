// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "umbrix/scene.h"
#include "workload/shadow_rays.h"

namespace umbrix::bench {

/// A frame's rays, in the order in which they are asked.
struct Phase {
  std::string name;  ///< "first", "next:0.01", "shuffled" or "area"
  std::vector<Ray> rays;
  std::vector<Ray> before;  ///< of the frame before, for "next"
  bool is_shuffled = false;
};

/// "first": the camera's rays to the light. "next:D": from a camera moved to its right by D of the scene's diagonal.
/// "shuffled": the first frame's in random order. "area": a quarter of the size each way, 16 rays from a point to a
/// sphere around the light, whose diameter is 1/40 of the diagonal, stratified. invalid_argument: another name.
Status make_phase(const std::string& name, const Scene& scene, const workload::Geometry& geometry,
                  const workload::Viewpoint& viewpoint, std::size_t light, int size, Phase& out);

}  // namespace umbrix::bench
