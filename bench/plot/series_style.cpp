// SPDX-License-Identifier: Apache-2.0
// Colours by Okabe and Ito, "Color Universal Design", 2008: told apart by the colour-blind as well.
#include "plot/series_style.h"

namespace umbrix::plot {
namespace {

constexpr const char* kColors[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"};
constexpr std::size_t kColorCount = std::size(kColors);
constexpr double kRadius = 3.5;

}  // namespace

std::string series_color(std::size_t index) { return kColors[index % kColorCount]; }

void draw_marker(Svg& svg, const Point& centre, std::size_t index) {
  const double x = centre.x, y = centre.y, r = kRadius;
  const std::string color = series_color(index);
  switch ((index % kColorCount + index / kColorCount) % 4) {
    case 0:
      return svg.circle(centre, r, color);
    case 1:
      return svg.rectangle(x - r, y - r, 2 * r, 2 * r, color);
    case 2:
      return svg.polygon({{x, y - 1.3 * r}, {x + 1.2 * r, y + r}, {x - 1.2 * r, y + r}}, color);
    default:
      return svg.polygon({{x, y - 1.4 * r}, {x + 1.4 * r, y}, {x, y + 1.4 * r}, {x - 1.4 * r, y}}, color);
  }
}

}  // namespace umbrix::plot
