// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "render/film.h"
#include "umbrix/io/image_file.h"

namespace umbrix::render {

/// Linear Rec.709, which a PNG is written from.
struct Color {
  float r = 0, g = 0, b = 0;
};

/// The colour that a PNG shows as 0xRRGGBB.
Color display_color(std::uint32_t rrggbb);

/// A picture to draw on. What lies beyond its edges is left out.
class Canvas {
 public:
  Canvas(int width, int height, Color background);

  int width() const { return image_.width; }
  int height() const { return image_.height; }

  void set(int x, int y, Color color);
  void fill(const PixelRect& area, Color color);

  /// One line of text, its upper left corner at x, y; each dot of its glyphs is a square of `dot` pixels.
  void text(int x, int y, int dot, const std::string& line, Color color);

  /// The drawn picture, with channels R, G and B.
  const io::Image& image() const { return image_; }

 private:
  io::Image image_;
};

/// Dots from the top of a line of text to the bottom of its descenders.
constexpr int kTextDots = 10;

/// The dots that `line` is wide.
int text_dots(const std::string& line);

}  // namespace umbrix::render
