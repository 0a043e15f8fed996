// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "render/direct_light.h"
#include "render/light_set.h"
#include "render/render.h"

namespace umbrix::render {

/// Follows a tile's paths from surface to surface. Scratch space is kept from call to call.
class Bounces {
 public:
  Bounces(const World& world, const LightSet& lights, const RenderOptions& options)
      : world_(world), lights_(lights), options_(options) {}

  /// Sends a ray on from each surface of a path that goes on, in a direction that its material chooses; the tile then
  /// holds the surfaces that they met, one bounce deeper. Adds what they saw of lights that direct light may find as
  /// well, weighted so that both together count once. `index` is the camera sample's. False if no path goes on.
  bool follow(std::uint32_t index, TileSamples& tile, RenderStats& stats);

 private:
  /// A path between two surfaces.
  struct Step {
    std::uint32_t sample;
    double density;     ///< of its direction, per steradian
    Receiver receiver;  ///< where it starts
  };

  bool choose(std::uint32_t index, std::uint32_t sample, TileSamples& tile);
  void trace(RenderStats& stats);
  void arrive(TileSamples& tile, RenderStats& stats);
  Rgb light_seen(const Step& step, const Vec3& direction, const Surface* surface) const;

  const World& world_;
  const LightSet& lights_;
  const RenderOptions& options_;
  std::vector<Step> steps_;
  std::vector<Ray> rays_;
  std::vector<Primitive> skip_;
  std::vector<Hit> hits_;
};

}  // namespace umbrix::render
