// SPDX-License-Identifier: Apache-2.0
// All points that a pixel's samples choose for one light are one stratified set, over camera samples and light samples
// alike, so that both numbers serve the light as well.
#include "render/light_rays.h"

namespace umbrix::render {
namespace {

/// Purposes of random numbers that are no light's own.
constexpr std::uint32_t kChoiceOfLight = 0xFFFFFFFFu, kPointOfChosen = 0xFFFFFFFEu;

}  // namespace

void LightRays::trace(std::uint32_t index, TileSamples& tile, std::vector<LightStats>& stats) {
  for (const std::uint32_t light : lights_.punctual()) ask_each(light, index, 1, tile, stats[light]);
  for (const std::uint32_t light : lights_.sampled()) {
    ask_each(light, index, options_.light_samples, tile, stats[light]);
  }
  if (lights_.chooses()) ask_chosen(index, tile, stats);
}

void LightRays::ask_each(std::uint32_t light, std::uint32_t index, std::uint32_t times, TileSamples& tile,
                         LightStats& stats) {
  const std::uint32_t count = options_.samples * times;
  for (std::uint32_t time = 0; time < times; ++time) {
    requests_.clear();
    for (std::uint32_t i = 0; i < tile.samples.size(); ++i) {
      if (!tile.samples[i].hit) continue;
      const Pixel pixel = tile.pixels[i];
      const SamplePoint u = purpose_sample(pixel.x, pixel.y, light, index * times + time, count, options_.seed);
      requests_.push_back({i, u, 1.0 / times});
    }
    direct_light_.add(lights_[light], light, requests_, tile, stats);
  }
}

void LightRays::ask_chosen(std::uint32_t index, TileSamples& tile, std::vector<LightStats>& stats) {
  // As many at a time as there would be lights that are asked one by one, to keep memory small.
  constexpr auto kAtOnce = static_cast<std::uint32_t>(kMostSampledLights);
  const std::uint32_t times = kAtOnce * options_.light_samples;
  for (std::uint32_t first = index * times; first < (index + 1) * times; first += kAtOnce) {
    for (std::uint32_t i = 0; i < tile.samples.size(); ++i) {
      if (tile.samples[i].hit) choose_lights(i, tile.pixels[i], first, times);
    }
    for (std::uint32_t light = 0; light < chosen_.size(); ++light) {
      if (chosen_[light].empty()) continue;
      direct_light_.add(lights_[light], light, chosen_[light], tile, stats[light]);
      chosen_[light].clear();
    }
  }
}

void LightRays::choose_lights(std::uint32_t sample, const Pixel& pixel, std::uint32_t first, std::uint32_t times) {
  for (std::uint32_t number = first; number < first + kMostSampledLights; ++number) {
    const auto point = [&](std::uint32_t purpose) {
      return purpose_sample(pixel.x, pixel.y, purpose, number, options_.samples * times, options_.seed);
    };
    const Choice choice = lights_.choice_of(point(kChoiceOfLight).y);
    chosen_[choice.index].push_back({sample, point(kPointOfChosen), 1 / (choice.probability * times)});
  }
}

}  // namespace umbrix::render
