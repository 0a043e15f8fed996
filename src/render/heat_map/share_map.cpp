// SPDX-License-Identifier: Apache-2.0
// Routes of shadow rays: a pixel mixes their colours, as light, by the shares of its rays. The legend names each route
// with its share of all rays.
#include <fmt/format.h>

#include <numeric>

#include "render/heat_map/color_map.h"
#include "render/heat_map/maps.h"

namespace umbrix::render {
namespace {

const Color kNoRay = display_color(0x202020);
constexpr int kSwatchDots = 9, kGapDots = 4;

/// A colour of the legend, and what it stands for.
struct Entry {
  Color color;
  std::string text;
  int x = 0, y = 0;  ///< from the first one
};

std::vector<Entry> entries_of(const RouteCounts<std::uint64_t>& rays, std::uint64_t all) {
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < kRayRoutes; ++i) {
    const double share = all > 0 ? static_cast<double>(rays[i]) / static_cast<double>(all) : 0;
    entries.push_back({route_color(static_cast<RayRoute>(i)), fmt::format("{} {:.1f} %", kRouteNames[i], 100 * share)});
  }
  entries.push_back({kNoRay, "no shadow ray"});
  return entries;
}

int entry_width(const Entry& entry, const LegendLayout& layout) {
  return (kSwatchDots + kGapDots) * layout.dot + layout.text_width(entry.text);
}

/// Places the entries one after another, on as many lines as `width` demands; returns the lines.
int place(std::vector<Entry>& entries, int width, const LegendLayout& layout) {
  int x = 0, line = 0;
  for (Entry& entry : entries) {
    if (x > 0 && x + entry_width(entry, layout) > width) {
      x = 0;
      ++line;
    }
    entry.x = x;
    entry.y = line * layout.line();
    x += entry_width(entry, layout) + 3 * kGapDots * layout.dot;
  }
  return line + 1;
}

Color mixed(const float* shares) {
  Color sum;
  float total = 0;
  for (std::size_t i = 0; i < kRayRoutes; ++i) {
    const Color color = route_color(static_cast<RayRoute>(i));
    sum = {sum.r + shares[i] * color.r, sum.g + shares[i] * color.g, sum.b + shares[i] * color.b};
    total += shares[i];
  }
  return total > 0 ? sum : kNoRay;
}

}  // namespace

io::Image share_map(const AovPixels& pixels, const RouteCounts<std::uint64_t>& rays) {
  const std::uint64_t all = std::accumulate(rays.begin(), rays.end(), std::uint64_t{0});
  const io::Image& image = pixels.image;
  const LegendLayout layout(image.width);
  const std::string title =
      fmt::format("{}: {} ({:.2f} M)", pixels.aov.name, pixels.aov.unit, 1e-6 * static_cast<double>(all));
  std::vector<Entry> entries = entries_of(rays, all);
  const int width = std::max(image.width, layout.text_width(title) + 2 * layout.margin());
  const int lines = 1 + place(entries, width - 2 * layout.margin(), layout);
  Canvas canvas(width, image.height + 2 * layout.margin() + lines * layout.line(), kPaper);

  for (int y = 0, i = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x, ++i) canvas.set(x, y, mixed(pixels.at(static_cast<std::size_t>(i))));
  }

  const int top = image.height + layout.margin();
  canvas.text(layout.margin(), top, layout.dot, title, kInk);
  for (const Entry& entry : entries) {
    const int x = layout.margin() + entry.x, y = top + layout.line() + entry.y;
    canvas.fill({x, y, kSwatchDots * layout.dot, kSwatchDots * layout.dot}, entry.color);
    canvas.text(x + (kSwatchDots + kGapDots) * layout.dot, y, layout.dot, entry.text, kInk);
  }
  return canvas.image();
}

}  // namespace umbrix::render
