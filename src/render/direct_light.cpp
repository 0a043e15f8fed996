// SPDX-License-Identifier: Apache-2.0
// Direct light: each request is one direction to a light, and one shadow ray. For punctual lights that is all there is
// to know; for those with an area it is one sample of the integral.
#include "render/direct_light.h"

#include <chrono>

#include "render/bsdf.h"
#include "render/shadow_ray.h"

namespace umbrix::render {
namespace {

/// Counts why no ray is needed.
void count_unreached(Unreached reason, LightStats& stats) {
  stats.skipped_range += reason == Unreached::beyond_range;
  stats.skipped_cone += reason == Unreached::outside_cone;
  stats.skipped_emitter += reason == Unreached::emitter_faces_away;
  stats.skipped_no_power += reason == Unreached::no_power;
}

/// The share of a way that rays sent by the material may find as well (balance heuristic, Veach 1997, section 9.2).
double weight_of(const Arrival& arrival, double share, double bsdf_density) {
  return arrival.density > 0 ? arrival.density / (arrival.density + share * bsdf_density) : 1;
}

}  // namespace

void DirectLight::add(const Light& light, std::uint32_t number, const std::vector<LightRequest>& requests,
                      TileSamples& tile, LightStats& stats) {
  gather(light, requests, tile, stats);
  const auto start = std::chrono::steady_clock::now();
  trace(number, tile, stats);
  stats.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  for (std::size_t i = 0; i < pending_.size(); ++i) {
    CameraSample& sample = tile.samples[pending_[i].sample];
    ++stats.routes[index_of(routes_[i])];
    ++(occluded_[i] ? stats.occluded : stats.unoccluded);
    if (!occluded_[i]) sample.add(pending_[i].radiance, tile.depth > 0);
    if (tile.depth > 0) continue;
    ++sample.shadow_rays;
    ++sample.routes[index_of(routes_[i])];
    sample.unoccluded += !occluded_[i];
  }
  if (!work_.empty()) count_work(tile.samples, stats);
}

void DirectLight::gather(const Light& light, const std::vector<LightRequest>& requests, const TileSamples& tile,
                         LightStats& stats) {
  rays_.clear();
  skip_.clear();
  pixels_.clear();
  pending_.clear();
  for (const LightRequest& request : requests) {
    const Surface& surface = tile.surfaces[request.sample];

    // Spend no ray where the light cannot reach, or where none of its light would be seen.
    const Receiver receiver = receiver_at(surface);
    const Arrival arrival = light.sample(receiver, request.u);
    if (arrival.unreached != Unreached::no) {
      count_unreached(arrival.unreached, stats);
      continue;
    }
    const Vec3 wi = glm::normalize(arrival.to_light);
    const double cosine = glm::dot(surface.shading_normal, wi);
    if (glm::dot(surface.geometric_normal, wi) <= 0 || cosine <= 0) {
      ++stats.skipped_behind;
      continue;
    }
    const Rgb bsdf = evaluate_bsdf(surface.bsdf, surface.shading_normal, surface.to_viewer, wi);
    Rgb radiance = tile.throughput[request.sample] * bsdf * arrival.irradiance * cosine * request.share;
    if (tile.goes_on) {
      radiance *=
          weight_of(arrival, request.share, bsdf_density(surface.bsdf, surface.shading_normal, surface.to_viewer, wi));
    }
    if (radiance == Rgb(0)) {
      ++stats.skipped_no_power;
      continue;
    }
    find_shadow_ray(receiver, arrival, rays_.emplace_back());
    skip_.push_back(surface.primitive);
    pixels_.push_back(tile.pixels[request.sample]);
    Pending& pending = pending_.emplace_back();
    pending.sample = request.sample;
    pending.radiance = radiance;
  }
}

void DirectLight::trace(std::uint32_t light, const TileSamples& tile, LightStats& stats) {
  occluded_.resize(rays_.size());
  routes_.assign(rays_.size(), RayRoute::other);
  // What the tracer learns from is where the camera looks.
  const FrameTracer* const tracer = tile.depth == 0 ? query_.tracer : nullptr;
  const bool counts_each = query_.count_work_per_ray || (query_.count_work && tracer);
  work_.assign(counts_each ? rays_.size() : 0, RayCounts());
  if (tracer) {
    ShadowTile asked;
    asked.light = light;
    asked.rays = {rays_.data(), rays_.size()};
    asked.skip = skip_.data();
    asked.pixels = pixels_.data();
    asked.routes = routes_.data();
    asked.each = work_.empty() ? nullptr : work_.data();
    tracer->occluded(asked, occluded_.data());
    return;
  }
  QueryOptions options;
  options.kernel = query_.kernel;
  options.skip = skip_.data();
  if (!counts_each && query_.count_work) {
    world_.scene.occluded({rays_.data(), rays_.size()}, occluded_.data(), stats.counts, options);
    return;
  }
  if (!counts_each) {
    world_.scene.occluded({rays_.data(), rays_.size()}, occluded_.data(), options);
    return;
  }
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    OcclusionCounts counts;
    options.skip = &skip_[i];
    world_.scene.occluded({&rays_[i], 1}, &occluded_[i], counts, options);
    work_[i] = counts.occluded;
    work_[i] += counts.unoccluded;
  }
}

void DirectLight::count_work(std::vector<CameraSample>& samples, LightStats& stats) const {
  for (std::size_t i = 0; i < pending_.size(); ++i) {
    samples[pending_[i].sample].node_tests += work_[i].node_tests;
    samples[pending_[i].sample].primitive_tests += work_[i].primitive_tests;
    (occluded_[i] ? stats.counts.occluded : stats.counts.unoccluded) += work_[i];
  }
}

}  // namespace umbrix::render
