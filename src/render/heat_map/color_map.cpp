// SPDX-License-Identifier: Apache-2.0
// Viridis is by Stefan van der Walt and Nathaniel Smith (BIDS, 2015), given to the public under CC0 1.0:
// https://bids.github.io/colormap. Of its 256 colours this is each 8th (33, evenly spaced, rounded to bytes);
// between them it is interpolated, which is off by less than two in 255.
//
// The colours of routes are of the palette by Okabe and Ito, "Color Universal Design", 2008.
#include "render/heat_map/color_map.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace umbrix::render {
namespace {

constexpr std::uint32_t kKnots[] = {0x440154, 0x470d60, 0x48186a, 0x482374, 0x472d7b, 0x453681, 0x424086,
                                    0x3f4989, 0x3b528b, 0x375a8d, 0x33638d, 0x2f6a8e, 0x2c728e, 0x297a8e,
                                    0x26818e, 0x23898e, 0x21908c, 0x1f988b, 0x1f9f88, 0x21a685, 0x28ae80,
                                    0x31b57b, 0x3ebc74, 0x4cc26c, 0x5dc963, 0x6ece58, 0x82d34c, 0x96d83f,
                                    0xabdc32, 0xc0df24, 0xd5e21a, 0xeae51a, 0xfde725

};
constexpr std::size_t kSpans = std::size(kKnots) - 1;
constexpr std::size_t kColors = 256;

std::uint32_t mix(std::uint32_t a, std::uint32_t b, double t) {
  std::uint32_t mixed = 0;
  for (int shift = 16; shift >= 0; shift -= 8) {
    const double from = (a >> shift) & 0xff, to = (b >> shift) & 0xff;
    mixed |= static_cast<std::uint32_t>(std::lround(from + (to - from) * t)) << shift;
  }
  return mixed;
}

std::array<Color, kColors> make_colors() {
  std::array<Color, kColors> colors;
  for (std::size_t i = 0; i < kColors; ++i) {
    const double place = static_cast<double>(i * kSpans) / (kColors - 1);
    const std::size_t knot = std::min(static_cast<std::size_t>(place), kSpans - 1);
    colors[i] = display_color(mix(kKnots[knot], kKnots[knot + 1], place - static_cast<double>(knot)));
  }
  return colors;
}

}  // namespace

Color viridis(double t) {
  static const std::array<Color, kColors> colors = make_colors();
  const double clamped = t > 0 ? std::min(t, 1.0) : 0;  // NaN: 0
  return colors[static_cast<std::size_t>(std::lround(clamped * (kColors - 1)))];
}

Color route_color(RayRoute route) {
  static const RouteCounts<Color> colors = {display_color(0x009e73), display_color(0xf0e442), display_color(0x56b4e9),
                                            display_color(0xe69f00), display_color(0xcc79a7)};
  return colors[index_of(route)];
}

}  // namespace umbrix::render
