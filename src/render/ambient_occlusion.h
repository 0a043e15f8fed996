// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "render/direct_light.h"
#include "render/render.h"

namespace umbrix::render {

/// How open to its surroundings a surface is: the share of directions, weighted by the cosine, in which nothing is
/// nearer than RenderOptions::ao_distance (Landis 2002). Scratch space is kept from call to call.
class AmbientOcclusion {
 public:
  AmbientOcclusion(const World& world, const RenderOptions& options) : world_(world), options_(options) {}

  /// Fills CameraSample::openness where the camera's rays met a surface, with RenderOptions::light_samples rays each.
  void trace(std::uint32_t index, TileSamples& tile);

 private:
  void look_around(std::uint32_t number, const TileSamples& tile);

  const World& world_;
  const RenderOptions& options_;
  std::vector<Ray> rays_;
  std::vector<Primitive> skip_;
  std::vector<std::uint32_t> samples_;  ///< of each ray
  std::vector<std::uint8_t> occluded_;
};

}  // namespace umbrix::render
