// SPDX-License-Identifier: Apache-2.0
// One number a pixel. The legend from top to bottom: the AOV's name and unit; a bar of the colours with ticks and
// their numbers; the largest value and the mean.
#include <fmt/format.h>

#include <cmath>

#include "render/heat_map/color_map.h"
#include "render/heat_map/heat_scale.h"
#include "render/heat_map/maps.h"
#include "render/round_ticks.h"

namespace umbrix::render {
namespace {

constexpr int kBarDots = 10, kTickDots = 3;

/// A figure as a person would say it: three digits that count.
std::string figure(double value) {
  return std::abs(value) >= 100 && std::abs(value) < 1e7 ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
}

std::string figures_line(const HeatScale& scale) {
  return fmt::format("max {}    mean {}{}", figure(scale.max), figure(scale.mean),
                     scale.without > 0 ? "    grey: nothing there" : "");
}

void draw_bar(Canvas& canvas, const PixelRect& bar, int border) {
  canvas.fill({bar.x - border, bar.y - border, bar.width + 2 * border, bar.height + 2 * border}, kInk);
  for (int x = 0; x < bar.width; ++x) {
    canvas.fill({bar.x + x, bar.y, 1, bar.height}, viridis(static_cast<double>(x) / (bar.width - 1)));
  }
}

/// A place on the scale, and its number below it.
struct Tick {
  double value;
  std::string label;
};

/// From the upper end down. An end that was asked for need not be a whole number of steps.
std::vector<Tick> ticks_of(const HeatScale& scale) {
  const bool whole = std::abs(std::remainder(scale.end, scale.step)) < 1e-6 * scale.step;
  const std::string end = whole ? tick_label(scale.end, scale.step) : fmt::format("{:.6g}", scale.end);
  std::vector<Tick> ticks = {{scale.end, (scale.clamps ? ">= " : "") + end}};
  for (int i = static_cast<int>(std::ceil(scale.end / scale.step - 1e-6)) - 1; i >= 0; --i) {
    ticks.push_back({i * scale.step, tick_label(i * scale.step, scale.step)});
  }
  return ticks;
}

/// Ticks below the bar, and below those the numbers; from the upper end down, whose number must not be left out where
/// two would touch.
void draw_ticks(Canvas& canvas, const PixelRect& bar, const HeatScale& scale, const LegendLayout& layout) {
  const int bottom = bar.y + bar.height + layout.dot;
  int free_until = canvas.width() - layout.margin();
  for (const auto& [value, label] : ticks_of(scale)) {
    const int x = bar.x + static_cast<int>(std::lround((bar.width - 1) * value / scale.end));
    canvas.fill({x - layout.dot / 2, bottom, layout.dot, kTickDots * layout.dot}, kInk);
    const int width = layout.text_width(label);
    const int left = std::min(std::max(x - width / 2, layout.margin()), canvas.width() - layout.margin() - width);
    if (left + width > free_until) continue;
    canvas.text(left, bottom + (kTickDots + 2) * layout.dot, layout.dot, label, kInk);
    free_until = left - 3 * layout.dot;
  }
}

}  // namespace

io::Image scale_map(const AovPixels& pixels, double end) {
  std::vector<float> values(pixels.size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = *pixels.at(i);
  const HeatScale scale = choose_heat_scale(values, end);

  const io::Image& image = pixels.image;
  const LegendLayout layout(image.width);
  const std::string title = fmt::format("{}: {}", pixels.aov.name, pixels.aov.unit);
  const std::string figures = figures_line(scale);
  const int text = std::max(layout.text_width(title), layout.text_width(figures));
  const int bar_height = (kBarDots + 2 + kTickDots) * layout.dot;
  Canvas canvas(std::max(image.width, text + 2 * layout.margin()),
                image.height + 2 * layout.margin() + 3 * layout.line() + bar_height, kPaper);

  for (int y = 0, i = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x, ++i) {
      const double value = values[static_cast<std::size_t>(i)];
      canvas.set(x, y, std::isfinite(value) ? viridis(value / scale.end) : kNothing);
    }
  }

  int y = image.height + layout.margin();
  canvas.text(layout.margin(), y, layout.dot, title, kInk);
  y += layout.line();
  const PixelRect bar = {layout.margin() + layout.dot, y + layout.dot,
                         canvas.width() - 2 * (layout.margin() + layout.dot), kBarDots * layout.dot};
  draw_bar(canvas, bar, layout.dot);
  draw_ticks(canvas, bar, scale, layout);
  y += bar_height + layout.line() + 3 * layout.dot;
  canvas.text(layout.margin(), y, layout.dot, figures, kInk);
  return canvas.image();
}

}  // namespace umbrix::render
