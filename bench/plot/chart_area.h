// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "plot/axis_scale.h"
#include "plot/svg.h"

namespace umbrix::plot {

constexpr double kTextSize = 13, kTitleSize = 16, kLine = 20, kPad = 12, kTickLength = 5;
constexpr const char *kInk = "#1a1a1a", *kGrid = "#dddddd", *kPaper = "#ffffff";

/// An estimate, since the font is the viewer's choice: rather too wide.
double text_width(const std::string& text, double size = kTextSize);

/// A name and how its sample is drawn, centred on a point and at most kSample wide.
struct LegendEntry {
  static constexpr double kSample = 24;
  std::string name;
  std::function<void(Svg&, const Point& centre)> draw;
};

/// A chart's frame, laid out from the outside in: title, legend and axis titles take their room, the plot gets the
/// rest. The order of calls is that of the members below.
class ChartArea {
 public:
  ChartArea(int width, int height, const std::string& title);

  void draw_legend(const std::vector<LegendEntry>& entries);

  /// Settles where the plot is. `right` may be null; `strip` pixels stay free between the plot and the x axis.
  void lay_out(const AxisScale& x, const AxisScale& y, const AxisScale* right, double strip = 0);
  void draw_x_axis(const std::string& title);
  void draw_y_axis(const std::string& title, bool on_right = false);

  /// Where a value pair lies, and whether it has a place within the axes.
  Point place(const Point& p, bool on_right = false) const;
  bool shows(const Point& p, bool on_right = false) const;

  Svg& svg() { return svg_; }
  double left() const { return left_; }
  double end() const { return end_; }
  double top() const { return top_; }
  double bottom() const { return bottom_; }           ///< of the plot
  double strip_bottom() const { return x_axis_at_; }  ///< where the x axis is

 private:
  const AxisScale& upwards(bool on_right) const { return on_right ? *right_ : *y_; }

  int width_, height_;
  Svg svg_;
  const AxisScale *x_ = nullptr, *y_ = nullptr, *right_ = nullptr;
  double left_ = 0, end_ = 0, top_ = 0, bottom_ = 0, x_axis_at_ = 0;
};

}  // namespace umbrix::plot
