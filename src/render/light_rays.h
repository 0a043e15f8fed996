// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "render/direct_light.h"
#include "render/light_set.h"
#include "render/render.h"

namespace umbrix::render {

/// Asks a frame's lights for a tile's camera samples: decides which light is asked how often, and with which points.
class LightRays {
 public:
  LightRays(const LightSet& lights, const RenderOptions& options, const DirectLight& direct_light)
      : lights_(lights), options_(options), direct_light_(direct_light), chosen_(lights.size()) {}

  /// Adds what reaches sample `index` of each of the tile's pixels. `stats` are the lights'.
  void trace(std::uint32_t index, TileSamples& tile, std::vector<LightStats>& stats);

 private:
  /// Fills requests_: one for each sample that met a surface.
  template <typename PointOf>
  void request(const TileSamples& tile, double share, const PointOf& point_of);

  void ask_each(std::uint32_t light, std::uint32_t index, TileSamples& tile, LightStats& stats);
  void ask_chosen(std::uint32_t index, TileSamples& tile, std::vector<LightStats>& stats);
  void choose_lights(std::uint32_t sample, const TileSamples& tile, std::uint32_t first, std::uint32_t times);

  const LightSet& lights_;
  const RenderOptions& options_;
  DirectLight direct_light_;
  std::vector<LightRequest> requests_;
  std::vector<std::vector<LightRequest>> chosen_;  ///< by light
};

}  // namespace umbrix::render
