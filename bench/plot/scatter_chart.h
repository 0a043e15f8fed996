// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plot/line_chart.h"

namespace umbrix::plot {

/// A point with the interval that its y may lie in, and a name that is shown beside it where there is room.
struct ScatterPoint {
  double x = 0, y = 0;
  double low = 0, high = 0;
  std::string label = {};
};

/// Points that look alike. Series of one style have one colour; the hollow one is a ring.
struct ScatterSeries {
  std::string name;       ///< for the legend; empty: not in it
  std::size_t style = 0;  ///< see series_color
  bool hollow = false;
  std::vector<ScatterPoint> points = {};
};

/// Rates over speed, say. On a logarithmic y axis points at 0 have a row of their own below the plot, in a lane for
/// each style; `zero_bound` is how large a rate may be of which none was seen: a dashed line in the plot, with a note.
struct ScatterChart {
  std::string title;
  Axis x, y;
  std::vector<ScatterSeries> series;
  std::optional<double> zero_bound;
  std::string zero_note;
  int width = 960, height = 520;  ///< pixels of 1/96 inch
};

/// The chart as an SVG document. The same chart gives the same bytes.
std::string svg_text(const ScatterChart& chart);

}  // namespace umbrix::plot
