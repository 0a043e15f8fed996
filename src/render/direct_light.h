// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "render/film.h"
#include "render/render_stats.h"
#include "render/surface.h"

namespace umbrix::render {

/// How shadow rays are asked for and what is counted on the way.
struct ShadowQuery {
  KernelId kernel;
  bool count_work = false;          ///< fill LightStats::counts
  bool count_work_per_ray = false;  ///< fill CameraSample's node and primitive tests as well
};

/// Adds the light of `light` to each sample that met a surface: one shadow ray where the light can reach, traced
/// together. `surfaces[i]` belongs to `samples[i]`. Scratch space is kept from call to call.
class DirectLight {
 public:
  DirectLight(const World& world, const ShadowQuery& query) : world_(world), query_(query) {}

  void add(const io::Light& light, const std::vector<Surface>& surfaces, std::vector<CameraSample>& samples,
           LightStats& stats);

 private:
  void gather(const io::Light& light, const std::vector<Surface>& surfaces, std::vector<CameraSample>& samples,
              LightStats& stats);
  void trace(std::vector<CameraSample>& samples, LightStats& stats);

  struct Pending {
    std::size_t sample;
    Rgb radiance;  ///< arrives at the viewer if nothing is in the way
  };

  const World& world_;
  ShadowQuery query_;
  std::vector<Ray> rays_;
  std::vector<Primitive> skip_;
  std::vector<Pending> pending_;
  std::vector<std::uint8_t> occluded_;
};

}  // namespace umbrix::render
