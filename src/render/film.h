// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "render/pixel_rect.h"
#include "render/ray_route.h"
#include "render/vec.h"
#include "umbrix/io/image_file.h"

namespace umbrix::render {

struct Aov;

/// What one camera ray found.
struct CameraSample {
  bool hit = false;                     ///< met a surface; if not, all below stays as it is but for the next two
  bool opaque = false;                  ///< met a surface or an environment
  Rgb radiance{0};                      ///< towards the camera
  Rgb indirect{0};                      ///< of that, what came over at least two surfaces
  double openness = 0;                  ///< share of the hemisphere that is free, if it is asked for
  double depth = 0;                     ///< along the viewing axis
  Vec3 normal{0};                       ///< shading normal, world space
  Rgb albedo{0};                        ///< base colour
  std::uint32_t shadow_rays = 0;        ///< traced, over all lights
  std::uint32_t unoccluded = 0;         ///< of those
  RouteCounts<std::uint32_t> routes{};  ///< of the shadow rays, by what answered them; sums to shadow_rays
  std::uint64_t node_tests = 0;         ///< of those rays, if counted
  std::uint64_t primitive_tests = 0;

  void add(const Rgb& light, bool over_two_surfaces) {
    radiance += light;
    if (over_two_surfaces) indirect += light;
  }
};

/// Gathers the samples of one tile's pixels, in double, and writes each pixel once when it is complete. Samples of a
/// pixel come in a fixed order, so the sums do not depend on the schedule.
class TileFilm {
 public:
  TileFilm(const std::vector<const Aov*>& aovs, const PixelRect& tile);

  /// `pixel` counts the tile's pixels row by row.
  void add(std::size_t pixel, const CameraSample& sample);

  /// `window` is the part of the frame that `image` holds; the tile lies within it.
  void write(const PixelRect& window, io::Image& image) const;

 private:
  const std::vector<const Aov*>& aovs_;
  PixelRect tile_;
  std::size_t channels_;
  std::vector<double> sums_;     ///< channels_ a pixel
  std::vector<double> weights_;  ///< one a pixel and AOV
};

}  // namespace umbrix::render
