// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "render/aovs/aov.h"
#include "render/heat_map/canvas.h"
#include "render/ray_route.h"

namespace umbrix::render {

/// An AOV's values in an image that has its channels.
struct AovPixels {
  const Aov& aov;
  const io::Image& image;
  std::size_t first_channel;

  std::size_t size() const { return image.pixels.size() / image.channels.size(); }
  const float* at(std::size_t pixel) const { return &image.pixels[pixel * image.channels.size() + first_channel]; }
};

/// The lengths of a legend, in pixels. They grow with the picture, which is likely to be shown smaller the larger it
/// is.
struct LegendLayout {
  explicit LegendLayout(int picture_width) : dot(1 + picture_width / 600) {}

  int dot;                                ///< of the font
  int line() const { return 14 * dot; }   ///< from one line of text to the next
  int margin() const { return 6 * dot; }  ///< around all
  int text_width(const std::string& text) const { return text_dots(text) * dot; }
};

inline const Color kPaper = display_color(0xffffff);
inline const Color kInk = display_color(0x1a1a1a);
inline const Color kNothing = display_color(0x808080);  ///< pixels without a value; no colour map holds a grey

/// The two kinds of heat map, each with its legend; `end` as in HeatMapContent.
io::Image scale_map(const AovPixels& pixels, double end);
io::Image share_map(const AovPixels& pixels, const RouteCounts<std::uint64_t>& rays);

}  // namespace umbrix::render
