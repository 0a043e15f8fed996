// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "umbrix/status.h"

/// Charts for reports and papers, as SVG.
namespace umbrix::plot {

struct Point {
  double x = 0, y = 0;
};

enum class Mark {
  line,  ///< from point to point, in the order given, with markers where there are few
  bars   ///< from 0 up to each point, centred on its x; several such series stand beside each other
};

/// Points that belong together. One that is not finite, or not positive on a logarithmic axis, is left out and
/// interrupts the line.
struct Series {
  std::string name;  ///< for the legend; empty: not in it
  std::vector<Point> points;
  Mark mark = Mark::line;
  bool on_right_axis = false;
  std::vector<std::array<double, 2>> band = {};  ///< low and high around each point; empty: none
};

struct Axis {
  std::string title;
  bool logarithmic = false;
  std::optional<double> low, high;  ///< none: as the points need, rounded; positive if logarithmic
};

/// What a chart shows. Texts are UTF-8. `right` is drawn if a series stands on it.
struct LineChart {
  std::string title;
  Axis x, y, right;
  std::vector<Series> series;
  int width = 640, height = 400;  ///< pixels of 1/96 inch
};

/// The chart as an SVG document. The same chart gives the same bytes.
std::string svg_text(const LineChart& chart);

/// Writes it to a file, which appears whole or not at all. output_failed names the file.
Status write_svg(const std::string& path, const LineChart& chart, bool overwrite);

}  // namespace umbrix::plot
