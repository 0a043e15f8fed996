// SPDX-License-Identifier: Apache-2.0
#include "render/light_set.h"

#include <algorithm>

#include "render/render.h"

namespace umbrix::render {
namespace {

/// Half by power, half all alike. Power says nothing of distance: a weak lamp nearby must not wait for rays until the
/// sun has had its many, or it becomes a few bright dots (a defensive mixture, Hesterberg 1995).
std::vector<double> choice_weights(const std::vector<double>& powers) {
  double total = 0, shining = 0;
  for (const double power : powers) {
    total += power;
    shining += power > 0;
  }
  std::vector<double> weights;
  weights.reserve(powers.size());
  for (const double power : powers) weights.push_back(power > 0 ? power / total + 1 / shining : 0);
  return weights;
}

}  // namespace

LightSet::LightSet(const World& world, const std::vector<io::Light>& lights) {
  std::vector<std::uint32_t> with_area;
  for (const io::Light& light : lights) {
    const auto number = static_cast<std::uint32_t>(lights_.size());
    const bool area = io::light_type_info(light.type).has(io::kHasArea);
    lights_.push_back(make_light(light, world));
    (area ? with_area : punctual_).push_back(number);
    if (light.type == io::LightType::mesh) mesh_lights_.emplace(light.instance, number);
    if (!lights_.back()->surrounds()) continue;
    surrounding_.push_back(number);
    if (light.visible) seen_.push_back(number);
  }
  if (with_area.size() <= kMostSampledLights) {
    sampled_ = std::move(with_area);
    return;
  }
  many_ = std::move(with_area);
  std::vector<double> powers;
  powers.reserve(many_.size());
  for (const std::uint32_t number : many_) powers.push_back(lights_[number]->power());
  by_power_ = DiscreteDistribution(choice_weights(powers));
}

Choice LightSet::choice_of(double u) const {
  Choice choice = by_power_.choose(u);
  choice.index = many_[choice.index];
  return choice;
}

double LightSet::expected_rays(std::uint32_t number, std::uint32_t light_samples) const {
  if (many_.empty()) return light_samples;
  if (!chooses()) return 0;
  const auto place = static_cast<std::size_t>(std::lower_bound(many_.begin(), many_.end(), number) - many_.begin());
  return by_power_.probability(place) * static_cast<double>(kMostSampledLights) * light_samples;
}

bool LightSet::find_mesh_light(const World& world, const Surface& surface, std::uint32_t& number) const {
  const auto found = mesh_lights_.find(world.meshes[surface.primitive.mesh].instance);
  if (found == mesh_lights_.end()) return false;
  number = found->second;
  return true;
}

Rgb LightSet::background(const Vec3& direction) const {
  Rgb sum(0);
  for (const std::uint32_t number : seen_) sum += lights_[number]->background(direction);
  return sum;
}

}  // namespace umbrix::render
