// SPDX-License-Identifier: Apache-2.0
#include "render/ambient_occlusion.h"

#include "render/sampling/directions.h"

namespace umbrix::render {

void AmbientOcclusion::trace(std::uint32_t index, TileSamples& tile) {
  const std::uint32_t times = options_.light_samples;
  QueryOptions query;
  query.kernel = options_.kernel;
  for (std::uint32_t number = index * times; number < (index + 1) * times; ++number) {
    look_around(number, tile);
    occluded_.resize(rays_.size());
    query.skip = skip_.data();
    world_.scene.occluded({rays_.data(), rays_.size()}, occluded_.data(), query);
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      if (!occluded_[i]) tile.samples[samples_[i]].openness += 1.0 / times;
    }
  }
}

/// Makes a ray for each surface; a direction that only the shading normal is above is blocked by the surface itself.
void AmbientOcclusion::look_around(std::uint32_t number, const TileSamples& tile) {
  rays_.clear();
  skip_.clear();
  samples_.clear();
  for (std::uint32_t i = 0; i < tile.samples.size(); ++i) {
    if (!tile.active[i]) continue;
    const Surface& surface = tile.surfaces[i];
    const Pixel& pixel = tile.pixels[i];
    const SamplePoint u =
        purpose_sample(pixel.x, pixel.y, kLookAround, number, options_.samples * options_.light_samples, options_.seed);
    const Vec3 direction = Frame3(surface.shading_normal).to_world(cosine_hemisphere(u));
    if (!(glm::dot(surface.geometric_normal, direction) > 0)) continue;
    Ray ray;
    store(surface.origin, ray.origin);
    store(direction, ray.direction);
    ray.tmin = 0;
    ray.tmax = options_.ao_distance;
    rays_.push_back(ray);
    skip_.push_back(surface.primitive);
    samples_.push_back(i);
  }
}

}  // namespace umbrix::render
