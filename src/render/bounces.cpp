// SPDX-License-Identifier: Apache-2.0
// Path tracing with direct light at each surface (Kajiya 1986; Pharr, Jakob & Humphreys 2023, chapter 13). What a ray
// meets of a light that direct light may choose too is weighted by the balance heuristic (Veach 1997, section 9.2).
#include "render/bounces.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "render/bsdf.h"
#include "render/shadow_ray.h"

namespace umbrix::render {
namespace {

/// Paths end at random from here on: those that carry little light sooner.
constexpr std::uint32_t kFirstRoulette = 2;
constexpr double kMostToGoOn = 0.95;

double largest(const Rgb& color) { return std::max({color.r, color.g, color.b}); }

}  // namespace

bool Bounces::follow(std::uint32_t index, TileSamples& tile, RenderStats& stats) {
  steps_.clear();
  rays_.clear();
  skip_.clear();
  for (std::uint32_t i = 0; i < tile.samples.size(); ++i) {
    tile.active[i] = tile.active[i] && choose(index, i, tile);
  }
  if (steps_.empty()) return false;
  trace(stats);
  ++tile.depth;
  arrive(tile, stats);
  return true;
}

/// Chooses where path `i` goes on, if it does.
bool Bounces::choose(std::uint32_t index, std::uint32_t i, TileSamples& tile) {
  const Pixel& pixel = tile.pixels[i];
  const std::uint64_t seed = tile.seed(options_.seed);
  const auto random = [&](std::uint32_t purpose) {
    return purpose_sample(pixel.x, pixel.y, purpose, index, options_.samples, seed);
  };
  const SamplePoint lobe_and_end = random(kLobeAndEnd);
  Rgb& throughput = tile.throughput[i];
  if (tile.depth >= kFirstRoulette) {
    const double chance = std::min(largest(throughput), kMostToGoOn);
    if (!(lobe_and_end.y < chance)) return false;
    throughput /= chance;
  }

  const Surface& surface = tile.surfaces[i];
  const Vec3 direction =
      sample_bsdf(surface.bsdf, surface.shading_normal, surface.to_viewer, lobe_and_end.x, random(kBounceDirection));
  const double cosine = glm::dot(surface.shading_normal, direction);
  if (!(cosine > 0 && glm::dot(surface.geometric_normal, direction) > 0)) return false;
  const double density = bsdf_density(surface.bsdf, surface.shading_normal, surface.to_viewer, direction);
  throughput *= evaluate_bsdf(surface.bsdf, surface.shading_normal, surface.to_viewer, direction) * (cosine / density);
  if (!(largest(throughput) > 0 && std::isfinite(largest(throughput)))) return false;

  Ray ray;
  store(surface.origin, ray.origin);
  store(direction, ray.direction);
  ray.tmin = 0;
  ray.tmax = std::numeric_limits<float>::infinity();
  rays_.push_back(ray);
  skip_.push_back(surface.primitive);
  steps_.push_back({i, density, receiver_at(surface)});
  return true;
}

void Bounces::trace(RenderStats& stats) {
  hits_.assign(rays_.size(), Hit());
  QueryOptions query;
  query.kernel = options_.kernel;
  query.skip = skip_.data();
  const auto start = std::chrono::steady_clock::now();
  world_.scene.closest({rays_.data(), rays_.size()}, hits_.data(), query);
  stats.bounce_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  stats.bounce_rays += rays_.size();
}

void Bounces::arrive(TileSamples& tile, RenderStats& stats) {
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    const std::uint32_t i = steps_[k].sample;
    const Vec3 direction = glm::normalize(load(rays_[k].direction));
    tile.active[i] = hits_[k].valid();
    if (tile.active[i]) {
      find_surface(world_, rays_[k], hits_[k], tile.surfaces[i]);
      ++stats.bounce_hits;
    }
    const Rgb seen = light_seen(steps_[k], direction, tile.active[i] ? &tile.surfaces[i] : nullptr);
    tile.samples[i].add(tile.throughput[i] * seen, tile.depth > 1);
  }
}

/// What a ray saw of lights, by its share.
Rgb Bounces::light_seen(const Step& step, const Vec3& direction, const Surface* surface) const {
  const auto weighted = [&](std::uint32_t number, const Rgb& radiance) {
    if (radiance == Rgb(0)) return Rgb(0);
    const double other = lights_[number].density(step.receiver, direction, surface) *
                         lights_.expected_rays(number, options_.light_samples);
    return radiance * (step.density / (step.density + other));
  };
  if (surface) {
    std::uint32_t number = 0;
    return surface->emission != Rgb(0) && lights_.find_mesh_light(world_, *surface, number)
               ? weighted(number, surface->emission)
               : Rgb(0);
  }
  Rgb sum(0);
  for (const std::uint32_t number : lights_.surrounding()) {
    sum += weighted(number, lights_[number].background(direction));
  }
  return sum;
}

}  // namespace umbrix::render
