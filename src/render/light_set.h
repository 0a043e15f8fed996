// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <unordered_map>
#include <vector>

#include "render/lights/light.h"
#include "render/sampling/discrete_distribution.h"
#include "render/surface.h"

namespace umbrix::render {

/// A view's lights, made for rendering, and which of them are asked. Const calls are thread-safe.
class LightSet {
 public:
  /// Throws std::bad_alloc.
  LightSet(const World& world, const std::vector<io::Light>& lights);

  std::size_t size() const { return lights_.size(); }
  const Light& operator[](std::size_t i) const { return *lights_[i]; }

  /// Numbers of the lights that each camera sample asks: once...
  const std::vector<std::uint32_t>& punctual() const { return punctual_; }
  /// ... or RenderOptions::light_samples times; those with an area, if they are few.
  const std::vector<std::uint32_t>& sampled() const { return sampled_; }

  /// Those with an area, if they are many: `choice_of` tells which of them a random number asks.
  bool chooses() const { return by_power_.total() > 0; }
  Choice choice_of(double u) const;

  /// How many rays a camera sample is expected to send to a light with an area.
  double expected_rays(std::uint32_t number, std::uint32_t light_samples) const;

  /// The light that a surface of the scene is part of, if there is one.
  bool find_mesh_light(const World& world, const Surface& surface, std::uint32_t& number) const;

  /// Numbers of the lights that surround the scene.
  const std::vector<std::uint32_t>& surrounding() const { return surrounding_; }

  /// What the camera sees where nothing is, in a unit direction, if there is a background.
  bool has_background() const { return !seen_.empty(); }
  Rgb background(const Vec3& direction) const;

 private:
  std::vector<std::unique_ptr<Light>> lights_;
  std::vector<std::uint32_t> punctual_, sampled_, surrounding_, seen_;
  std::vector<std::uint32_t> many_;  ///< what by_power_ chooses among
  DiscreteDistribution by_power_;
  std::unordered_map<std::uint32_t, std::uint32_t> mesh_lights_;  ///< by instance
};

}  // namespace umbrix::render
