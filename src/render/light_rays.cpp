// SPDX-License-Identifier: Apache-2.0
// All points that a pixel's samples choose for one light are one stratified set, over camera samples and light samples
// alike, so that both numbers serve the light as well.
#include "render/light_rays.h"

namespace umbrix::render {

void LightRays::trace(std::uint32_t index, TileSamples& tile, std::vector<LightStats>& stats) {
  if (!lights_.punctual().empty()) {
    request(tile, 1, [](const Pixel&) { return SamplePoint(); });
    for (const std::uint32_t light : lights_.punctual()) {
      direct_light_.add(lights_[light], light, requests_, tile, stats[light]);
    }
  }
  for (const std::uint32_t light : lights_.sampled()) ask_each(light, index, tile, stats[light]);
  if (lights_.chooses()) ask_chosen(index, tile, stats);
}

template <typename PointOf>
void LightRays::request(const TileSamples& tile, double share, const PointOf& point_of) {
  requests_.clear();
  for (std::uint32_t i = 0; i < tile.samples.size(); ++i) {
    if (tile.active[i]) requests_.push_back({i, point_of(tile.pixels[i]), share});
  }
}

void LightRays::ask_each(std::uint32_t light, std::uint32_t index, TileSamples& tile, LightStats& stats) {
  const std::uint32_t times = options_.light_samples;
  const std::uint64_t seed = tile.seed(options_.seed);
  for (std::uint32_t number = index * times; number < (index + 1) * times; ++number) {
    request(tile, 1.0 / times, [&](const Pixel& pixel) {
      return purpose_sample(pixel.x, pixel.y, light, number, options_.samples * times, seed);
    });
    direct_light_.add(lights_[light], light, requests_, tile, stats);
  }
}

void LightRays::ask_chosen(std::uint32_t index, TileSamples& tile, std::vector<LightStats>& stats) {
  // As many at a time as there would be lights that are asked one by one, to keep memory small.
  constexpr auto kAtOnce = static_cast<std::uint32_t>(kMostSampledLights);
  const std::uint32_t times = kAtOnce * options_.light_samples;
  for (std::uint32_t first = index * times; first < (index + 1) * times; first += kAtOnce) {
    for (std::uint32_t i = 0; i < tile.samples.size(); ++i) {
      if (tile.active[i]) choose_lights(i, tile, first, times);
    }
    for (std::uint32_t light = 0; light < chosen_.size(); ++light) {
      if (chosen_[light].empty()) continue;
      direct_light_.add(lights_[light], light, chosen_[light], tile, stats[light]);
      chosen_[light].clear();
    }
  }
}

void LightRays::choose_lights(std::uint32_t sample, const TileSamples& tile, std::uint32_t first, std::uint32_t times) {
  const Pixel& pixel = tile.pixels[sample];
  const std::uint64_t seed = tile.seed(options_.seed);
  for (std::uint32_t number = first; number < first + kMostSampledLights; ++number) {
    const auto point = [&](std::uint32_t purpose) {
      return purpose_sample(pixel.x, pixel.y, purpose, number, options_.samples * times, seed);
    };
    const Choice choice = lights_.choice_of(point(kChoiceOfLight).y);
    chosen_[choice.index].push_back({sample, point(kPointOfChosen), 1 / (choice.probability * times)});
  }
}

}  // namespace umbrix::render
