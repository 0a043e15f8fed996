// SPDX-License-Identifier: Apache-2.0
#include "render/heat_map/canvas.h"

#include <algorithm>
#include <cmath>

namespace umbrix::render {
namespace {

// IEC 61966-2-1, of a byte.
float linear_of(std::uint32_t byte) {
  const float x = static_cast<float>(byte & 0xff) / 255;
  return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f);
}

}  // namespace

Color display_color(std::uint32_t rrggbb) {
  return {linear_of(rrggbb >> 16), linear_of(rrggbb >> 8), linear_of(rrggbb)};
}

Canvas::Canvas(int width, int height, Color background) {
  image_.width = width;
  image_.height = height;
  image_.channels = {"R", "G", "B"};
  image_.pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
  fill({0, 0, width, height}, background);
}

void Canvas::set(int x, int y, Color color) {
  if (x < 0 || y < 0 || x >= width() || y >= height()) return;
  const auto row = static_cast<std::size_t>(y) * static_cast<std::size_t>(width());
  float* pixel = &image_.pixels[(row + static_cast<std::size_t>(x)) * 3];
  pixel[0] = color.r;
  pixel[1] = color.g;
  pixel[2] = color.b;
}

void Canvas::fill(const PixelRect& area, Color color) {
  for (int y = std::max(area.y, 0); y < std::min(area.y + area.height, height()); ++y) {
    for (int x = std::max(area.x, 0); x < std::min(area.x + area.width, width()); ++x) set(x, y, color);
  }
}

}  // namespace umbrix::render
