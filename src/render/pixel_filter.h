// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

namespace umbrix::render {

/// How a pixel weights the image around its centre, in each axis.
enum class PixelFilter {
  box,              ///< the pixel's own square, evenly
  triangle,         ///< linear to one pixel away
  gaussian,         ///< standard deviation 0.5, cut at 1.5 pixels
  blackman_harris,  ///< cosines, zero at 1.5 pixels: as smooth, and a little sharper
};

/// Chooses places around a pixel's centre in proportion to a filter's weight, so that each sample counts alike and
/// belongs to one pixel (Ernst, Stamminger & Greiner 2006, "Filter Importance Sampling"). So pixels still do not depend
/// on tiles.
class FilterSampler {
 public:
  explicit FilterSampler(PixelFilter filter);

  /// Pixels from the centre, for u in [0, 1); 0 for u = 0.5.
  double offset(double u) const;

 private:
  static constexpr std::size_t kSteps = 1024;

  /// From the centre outwards: within these pixels of it are equal steps of the weight. Linear in between.
  std::array<double, kSteps + 1> quantiles_{};
};

}  // namespace umbrix::render
