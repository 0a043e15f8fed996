// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "umbrix/umbrix.h"

namespace umbrix::frame_tests {

/// Every way to set up a frame tracer that makes a difference.
std::vector<FrameOptions> all_options();

/// As in the paper: regions of the screen, one ray of each, links from the lights on, large triangles in the index.
FrameOptions paper_options();

std::string describe(const FrameOptions& options);

/// What a test hands over beside the rays.
struct Handover {
  std::size_t tile = 256;  ///< rays a call
  std::uint32_t light = 0;
  std::uint32_t mask = 0xFFFFFFFFu;
  const Primitive* skip = nullptr;
  const Pixel* pixels = nullptr;
  RayRoute* routes = nullptr;
  RayCounts* each = nullptr;
};

/// Hands rays over, tile by tile.
std::vector<std::uint8_t> trace(const FrameTracer& tracer, const std::vector<Ray>& rays, const Handover& how = {});

/// The truth: each ray against each triangle.
std::vector<std::uint8_t> brute(const Scene& scene, const std::vector<Ray>& rays, const Handover& how = {});

/// The rays in another order, the same for a seed.
std::vector<Ray> shuffled(std::vector<Ray> rays, std::uint32_t seed);

/// The rays with their origins moved along them by `step` directions.
std::vector<Ray> moved(std::vector<Ray> rays, float step);

/// Pixels of an image `width` wide, row by row.
std::vector<Pixel> pixel_rows(std::size_t count, std::uint32_t width);

/// A floor, a roof over parts of it, and one shadow ray a pixel from the floor to a light above. Pixels come in blocks
/// of 4x4 within tiles of 16x16.
struct Hall {
  static constexpr std::uint32_t kWidth = 96;

  Scene scene;
  std::vector<Pixel> pixels;

  Hall();
  /// For a camera that has moved by `shift` of a pixel.
  std::vector<Ray> rays(float shift = 0, float light_x = 0.3f) const;
};

/// A view of a frame with nothing but its number.
inline FrameView numbered(std::int64_t frame) {
  FrameView view;
  view.frame = frame;
  return view;
}

}  // namespace umbrix::frame_tests
