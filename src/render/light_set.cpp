// SPDX-License-Identifier: Apache-2.0
#include "render/light_set.h"

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
    if (lights_.back()->surrounds()) surrounding_.push_back(number);
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

Rgb LightSet::background(const Vec3& direction) const {
  Rgb sum(0);
  for (const std::uint32_t number : surrounding_) sum += lights_[number]->background(direction);
  return sum;
}

}  // namespace umbrix::render
