// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "plot/line_chart.h"

namespace umbrix::plot {

/// Text that may stand in XML, between tags or in quotes.
std::string xml_text(const std::string& text);

enum class Anchor { start, middle, end };

/// An SVG document that grows by what is drawn. Coordinates are pixels from the upper left corner, colours "#rrggbb".
class Svg {
 public:
  Svg(int width, int height);

  void rectangle(double x, double y, double width, double height, const std::string& fill);
  void line(const Point& from, const Point& to, const std::string& stroke, double width);
  void dashed_line(const Point& from, const Point& to, const std::string& stroke, double width);
  void polyline(const std::vector<Point>& points, const std::string& stroke, double width);
  void polygon(const std::vector<Point>& points, const std::string& fill, double opacity = 1);
  void circle(const Point& centre, double radius, const std::string& fill);
  void ring(const Point& centre, double radius, const std::string& stroke, double width);

  /// `at` is on the line that letters stand on; `degrees` turn the text about it, clockwise.
  void text(const Point& at, const std::string& text, Anchor anchor, double size, double degrees = 0);

  /// The whole document.
  std::string document() const { return body_ + "</svg>\n"; }

 private:
  void add_line(const Point& from, const Point& to, const std::string& stroke, double width, const std::string& more);

  std::string body_;
};

}  // namespace umbrix::plot
