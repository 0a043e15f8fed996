// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "umbrix/io/scene_file.h"
#include "umbrix/status.h"
#include "workload/geometry.h"

namespace umbrix::bench {

struct ImageCurveOptions {
  std::vector<std::uint32_t> samples = {1, 4, 16, 64};  ///< shadow rays a pixel; empty: no images
  std::uint32_t reference = 4096;                       ///< of each of the two halves of the reference
  int size = 256;                                       ///< pixels in each direction
  int seeds = 5;                                        ///< images for each number of samples
  double radius = 0.015;  ///< of the sphere that stands for a light without an area, in scene diagonals
  std::vector<std::string> kernels = {"standard", "far-first", "wide", "beam", "frames:best"};
  std::string keep;  ///< a folder for the images as PNG, named SCENE-reference and SCENE-SAMPLES-SEED; empty: none
};

/// Whether images may have this light: it has an area, or a place that a sphere can be put around.
bool can_have_area(const io::Light& light);

/// Renders direct light from one light, for which can_have_area is true, with one camera ray through each pixel's
/// centre, and compares with a reference of other seeds. Every kernel renders every image, on one thread,
/// by turns; internal if two images of the same seed differ in a bit. Adds a member for the scene to `out`:
/// {"scene", "light", "reference", "points": [{"samples", "rmse", ..., "times"}]}.
Status measure_images(const workload::Geometry& geometry, const io::Camera& camera, const io::Light& light,
                      const ImageCurveOptions& options, nlohmann::json& out);

}  // namespace umbrix::bench
