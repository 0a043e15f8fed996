// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "render/ray_route.h"
#include "umbrix/stats.h"

namespace umbrix::render {

/// What one light cost: each time that a camera sample on a surface asks for it, which may be more than once, it costs
/// either a shadow ray or is skipped for one reason.
struct LightStats {
  std::uint64_t occluded = 0;  ///< shadow rays
  std::uint64_t unoccluded = 0;
  std::uint64_t skipped_behind = 0;     ///< the surface faces away
  std::uint64_t skipped_range = 0;      ///< beyond the light's range
  std::uint64_t skipped_cone = 0;       ///< outside the spot's cone
  std::uint64_t skipped_emitter = 0;    ///< the light shines on its other side
  std::uint64_t skipped_no_power = 0;   ///< black light, or black surface
  RouteCounts<std::uint64_t> routes{};  ///< shadow rays by what answered them
  OcclusionCounts counts;               ///< if asked for; rays of both classes sum to the above
  double seconds = 0;                   ///< in occluded(), summed over threads

  std::uint64_t rays() const noexcept { return occluded + unoccluded; }
  std::uint64_t skipped() const noexcept {
    return skipped_behind + skipped_range + skipped_cone + skipped_emitter + skipped_no_power;
  }

  LightStats& operator+=(const LightStats& o) noexcept {
    occluded += o.occluded;
    unoccluded += o.unoccluded;
    skipped_behind += o.skipped_behind;
    skipped_range += o.skipped_range;
    skipped_cone += o.skipped_cone;
    skipped_emitter += o.skipped_emitter;
    skipped_no_power += o.skipped_no_power;
    for (std::size_t i = 0; i < kRayRoutes; ++i) routes[i] += o.routes[i];
    counts.occluded += o.counts.occluded;
    counts.unoccluded += o.counts.unoccluded;
    seconds += o.seconds;
    return *this;
  }
};

/// What a render did. Everything but the seconds is the same for any number of threads; of routes that holds if work
/// is counted.
struct RenderStats {
  std::uint64_t camera_rays = 0;
  std::uint64_t camera_hits = 0;
  double camera_seconds = 0;      ///< in closest(), summed over threads
  std::uint64_t bounce_rays = 0;  ///< from surface to surface
  std::uint64_t bounce_hits = 0;
  double bounce_seconds = 0;
  std::vector<LightStats> lights;  ///< in the order given
  double seconds = 0;              ///< of the wall clock
  FrameStats frame;                ///< of the tracer, if there was one; of the last part added

  /// The sum over the lights.
  LightStats shadow() const noexcept {
    LightStats sum;
    for (const LightStats& light : lights) sum += light;
    return sum;
  }

  /// Adds another part of the same render (with as many lights).
  RenderStats& operator+=(const RenderStats& o) {
    camera_rays += o.camera_rays;
    camera_hits += o.camera_hits;
    camera_seconds += o.camera_seconds;
    bounce_rays += o.bounce_rays;
    bounce_hits += o.bounce_hits;
    bounce_seconds += o.bounce_seconds;
    lights.resize(o.lights.size());
    for (std::size_t i = 0; i < lights.size(); ++i) lights[i] += o.lights[i];
    frame = o.frame;
    return *this;
  }
};

}  // namespace umbrix::render
