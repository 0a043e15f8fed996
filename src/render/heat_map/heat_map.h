// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "render/render_stats.h"
#include "umbrix/io/image_file.h"
#include "umbrix/status.h"

namespace umbrix::render {

/// What a heat map shows.
struct HeatMapContent {
  std::string aov;
  double end = 0;  ///< of the scale, if it has one (see AovInfo); 0: what suits the image
};

/// Draws one AOV of a rendered image in colours that a person can read, with a legend below, as a picture for a PNG
/// (channels R, G and B). The image's pixels are at its upper left, one for one; the picture is wider than the image
/// only if the legend needs it.
///
/// One number a pixel goes through viridis, from 0 to `end`; what suits an image is its 99.5th percentile rounded up.
/// Where that is less than the largest value, the legend says ">=". The `kernel` AOV mixes one colour for each route;
/// `stats`, of the same render, give the routes' shares of all rays.
///
/// invalid_argument: no such AOV, one that is no heat map (see AovInfo), or not in the image. resource_limit: memory.
Status make_heat_map(const HeatMapContent& content, const io::Image& image, const RenderStats& stats,
                     io::Image& picture);

}  // namespace umbrix::render
