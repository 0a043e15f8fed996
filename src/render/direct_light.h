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
  const FrameTracer* tracer = nullptr;  ///< in a frame: answers in place of the kernel
  bool count_work = false;              ///< fill LightStats::counts
  bool count_work_per_ray = false;      ///< fill CameraSample's node and primitive tests as well
};

/// Adds the light of `light` to each sample that met a surface: one shadow ray where the light can reach, traced
/// together. `surfaces[i]` belongs to `samples[i]`. Scratch space is kept from call to call.
class DirectLight {
 public:
  DirectLight(const World& world, const ShadowQuery& query) : world_(world), query_(query) {}

  /// `number` is the light's, `pixels[i]` of samples[i].
  void add(const io::Light& light, std::uint32_t number, const std::vector<Surface>& surfaces,
           const std::vector<Pixel>& pixels, std::vector<CameraSample>& samples, LightStats& stats);

 private:
  void gather(const io::Light& light, const std::vector<Surface>& surfaces, const std::vector<Pixel>& pixels,
              std::vector<CameraSample>& samples, LightStats& stats);
  void trace(std::uint32_t light, LightStats& stats);
  void count_work(std::vector<CameraSample>& samples, LightStats& stats) const;

  struct Pending {
    std::size_t sample;
    Rgb radiance;  ///< arrives at the viewer if nothing is in the way
  };

  const World& world_;
  ShadowQuery query_;
  std::vector<Ray> rays_;
  std::vector<Primitive> skip_;
  std::vector<Pending> pending_;
  std::vector<Pixel> pixels_;
  std::vector<std::uint8_t> occluded_;
  std::vector<RayRoute> routes_;
  std::vector<RayCounts> work_;  ///< of each ray, if counted
};

}  // namespace umbrix::render
