// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "render/film.h"
#include "render/lights/light.h"
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

/// Asks what one light sends to one of a tile's samples.
struct LightRequest {
  std::uint32_t sample;  ///< number of the CameraSample
  SamplePoint u;         ///< as for Light::sample
  double share;          ///< of what arrives that counts: one over the rays that are expected there
};

/// A tile's camera samples and where their paths are: what is at place i of each list belongs together.
struct TileSamples {
  std::vector<Pixel> pixels;
  std::vector<CameraSample> samples;
  std::vector<std::uint8_t> active;  ///< is the path at a surface?
  std::vector<Surface> surfaces;
  std::vector<Rgb>
      throughput;           ///< of light that leaves the surface towards the path, the share that reaches the camera
  std::uint32_t depth = 0;  ///< of all paths: bounces between the camera and these surfaces
  bool goes_on = false;     ///< rays are sent on from these surfaces, and may meet lights that are also asked

  /// Random numbers at each depth are their own.
  std::uint64_t seed(std::uint64_t of_frame) const { return of_frame + depth * 0x9E3779B97F4A7C15u; }
};

/// Adds the light of one light to samples that met a surface: a shadow ray for each request where the light can reach,
/// traced together. Scratch space is kept from call to call.
class DirectLight {
 public:
  DirectLight(const World& world, const ShadowQuery& query) : world_(world), query_(query) {}

  /// `number` is the light's. Requests are in the order of the samples, near ones near each other.
  void add(const Light& light, std::uint32_t number, const std::vector<LightRequest>& requests, TileSamples& tile,
           LightStats& stats);

 private:
  void gather(const Light& light, const std::vector<LightRequest>& requests, const TileSamples& tile,
              LightStats& stats);
  void trace(std::uint32_t light, const TileSamples& tile, LightStats& stats);
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
