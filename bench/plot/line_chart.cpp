// SPDX-License-Identifier: Apache-2.0
// From the outside in: title, legend and axis titles take their room, the plot gets the rest; then grid and axes, bars,
// lines, so that the thin is above the broad.
#include "plot/line_chart.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "plot/axis_scale.h"
#include "plot/series_style.h"
#include "plot/svg.h"
#include "umbrix/io/image_file.h"

namespace umbrix::plot {
namespace {

constexpr double kTextSize = 13, kTitleSize = 16, kLine = 20, kPad = 12, kTickLength = 5, kSample = 24;
constexpr std::size_t kMostMarkers = 40;
constexpr const char *kInk = "#1a1a1a", *kGrid = "#dddddd", *kPaper = "#ffffff";

/// An estimate, since the font is the viewer's choice: rather too wide.
double text_width(const std::string& text) { return 0.63 * kTextSize * static_cast<double>(text.size()); }

double widest_label(const AxisScale& scale) {
  double width = 0;
  for (const Tick& tick : scale.ticks) width = std::max(width, text_width(tick.label));
  return width;
}

/// Draws one chart.
class Painter {
 public:
  explicit Painter(const LineChart& chart) : chart_(chart), svg_(chart.width, chart.height) {
    for (const Series& s : chart.series) {
      has_right_ = has_right_ || s.on_right_axis;
      bar_series_ += s.mark == Mark::bars;
    }
    const int most_up = std::max(2, chart.height / 50), most_along = std::max(2, chart.width / 70);
    x_ = fit_axis(chart.x, range_along(), most_along);
    y_ = fit_axis(chart.y, range_upwards(false), most_up);
    right_ = fit_axis(chart.right, range_upwards(true), most_up);
  }

  std::string paint() {
    svg_.rectangle(0, 0, chart_.width, chart_.height, kPaper);
    double top = kPad;
    if (!chart_.title.empty()) {
      svg_.text({chart_.width / 2.0, top + kTitleSize}, chart_.title, Anchor::middle, kTitleSize);
      top += kTitleSize + kPad;
    }
    top = draw_legend(top);
    top_ = top + kPad;
    bottom_ = chart_.height - kPad - 2 * kLine - kTickLength;
    left_ = kPad + kLine + widest_label(y_) + kTickLength + 4;
    end_ = chart_.width - (has_right_ ? kPad + kLine + widest_label(right_) + kTickLength + 4 : 2 * kPad);
    draw_x_axis();
    draw_upwards_axis(y_, chart_.y.title, false);
    if (has_right_) draw_upwards_axis(right_, chart_.right.title, true);
    std::size_t bars = 0;
    for (std::size_t i = 0; i < chart_.series.size(); ++i) {
      if (chart_.series[i].mark == Mark::bars) draw_bars(i, bars++);
    }
    svg_.line({left_, bottom_}, {end_, bottom_}, kInk, 1);
    for (std::size_t i = 0; i < chart_.series.size(); ++i) {
      if (chart_.series[i].mark == Mark::line) draw_line(i);
    }
    return svg_.document();
  }

 private:
  const AxisScale& upwards(const Series& series) const { return series.on_right_axis ? right_ : y_; }

  Point place(const Series& series, const Point& p) const {
    return {left_ + x_.place(p.x) * (end_ - left_), bottom_ - upwards(series).place(p.y) * (bottom_ - top_)};
  }

  /// Whether the point has a place and is within the axes.
  bool shown(const Series& series, const Point& p) const {
    if (!x_.shows(p.x) || !upwards(series).shows(p.y)) return false;
    const double x = x_.place(p.x), y = upwards(series).place(p.y);
    constexpr double kEdge = 1e-9;
    return x >= -kEdge && x <= 1 + kEdge && y >= -kEdge && y <= 1 + kEdge;
  }

  Range range_along() const {
    AxisScale kind;
    kind.logarithmic = chart_.x.logarithmic;
    Range range;
    for (const Series& s : chart_.series) {
      // The outer bars are half a bar wider than their points.
      const double half = s.mark == Mark::bars && !kind.logarithmic ? smallest_gap(s) / 2 : 0;
      for (const Point& p : s.points) {
        if (!kind.shows(p.x)) continue;
        range.add(p.x - half);
        range.add(p.x + half);
      }
    }
    return range;
  }

  Range range_upwards(bool right) const {
    AxisScale kind;
    kind.logarithmic = (right ? chart_.right : chart_.y).logarithmic;
    Range range;
    for (const Series& s : chart_.series) {
      if (s.on_right_axis != right) continue;
      for (const Point& p : s.points) {
        if (kind.shows(p.y)) range.add(p.y);
      }
    }
    if (!kind.logarithmic && !range.empty) range.add(0);
    return range;
  }

  static double smallest_gap(const Series& series) {
    std::vector<double> xs;
    for (const Point& p : series.points) {
      if (std::isfinite(p.x)) xs.push_back(p.x);
    }
    std::sort(xs.begin(), xs.end());
    double gap = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < xs.size(); ++i) {
      if (xs[i] > xs[i - 1]) gap = std::min(gap, xs[i] - xs[i - 1]);
    }
    return std::isfinite(gap) ? gap : 1;
  }

  /// Names and samples of the series in lines below `top`; returns where they end.
  double draw_legend(double top) {
    double x = 2 * kPad, y = top;
    bool any = false;
    for (std::size_t i = 0; i < chart_.series.size(); ++i) {
      const Series& series = chart_.series[i];
      if (series.name.empty()) continue;
      const std::string name = series.name + (series.on_right_axis ? " (right)" : "");
      const double width = kSample + 6 + text_width(name) + kLine;
      if (any && x + width > chart_.width) {
        x = 2 * kPad;
        y += kLine;
      }
      const double middle = y + kLine / 2;
      if (series.mark == Mark::bars) {
        svg_.rectangle(x + kSample / 4, middle - 6, kSample / 2, 12, series_color(i));
      } else {
        svg_.line({x, middle}, {x + kSample, middle}, series_color(i), 2);
        draw_marker(svg_, {x + kSample / 2, middle}, i);
      }
      svg_.text({x + kSample + 6, middle + 0.35 * kTextSize}, name, Anchor::start, kTextSize);
      x += width;
      any = true;
    }
    return any ? y + kLine : y;
  }

  void draw_x_axis() {
    for (const Tick& tick : x_.ticks) {
      const double x = left_ + x_.place(tick.value) * (end_ - left_);
      svg_.line({x, bottom_}, {x, bottom_ + (tick.label.empty() ? 0.6 : 1) * kTickLength}, kInk, 1);
      svg_.text({x, bottom_ + kTickLength + kTextSize + 2}, tick.label, Anchor::middle, kTextSize);
    }
    svg_.text({(left_ + end_) / 2, chart_.height - kPad}, chart_.x.title, Anchor::middle, kTextSize);
  }

  void draw_upwards_axis(const AxisScale& scale, const std::string& title, bool right) {
    const double x = right ? end_ : left_, outwards = right ? 1 : -1;
    for (const Tick& tick : scale.ticks) {
      const double y = bottom_ - scale.place(tick.value) * (bottom_ - top_);
      if (!right) svg_.line({left_, y}, {end_, y}, kGrid, 1);
      svg_.line({x, y}, {x + outwards * (tick.label.empty() ? 0.6 : 1) * kTickLength, y}, kInk, 1);
      svg_.text({x + outwards * (kTickLength + 4), y + 0.35 * kTextSize}, tick.label,
                right ? Anchor::start : Anchor::end, kTextSize);
    }
    svg_.line({x, top_}, {x, bottom_}, kInk, 1);
    const Point at = {right ? chart_.width - kPad - 4 : kPad + kTextSize, (top_ + bottom_) / 2};
    svg_.text(at, title, Anchor::middle, kTextSize, right ? 90 : -90);
  }

  void draw_bars(std::size_t index, std::size_t place_in_group) {
    const Series& series = chart_.series[index];
    double group = end_ - left_;
    std::vector<Point> tops;
    for (const Point& p : series.points) {
      if (shown(series, p)) tops.push_back(place(series, p));
    }
    std::sort(tops.begin(), tops.end(), [](const Point& a, const Point& b) { return a.x < b.x; });
    for (std::size_t i = 1; i < tops.size(); ++i) group = std::min(group, tops[i].x - tops[i - 1].x);
    if (tops.size() == 1) group /= 4;
    const double width = 0.9 * group / static_cast<double>(bar_series_);
    const AxisScale& scale = upwards(series);
    const double zero = scale.logarithmic ? bottom_ : bottom_ - std::clamp(scale.place(0), 0.0, 1.0) * (bottom_ - top_);
    for (const Point& p : tops) {
      const double x = p.x - 0.45 * group + width * static_cast<double>(place_in_group);
      svg_.rectangle(x, std::min(p.y, zero), width, std::abs(zero - p.y), series_color(index));
    }
  }

  void draw_line(std::size_t index) {
    const Series& series = chart_.series[index];
    std::vector<Point> piece, all;
    const auto flush = [&] {
      if (piece.size() > 1) svg_.polyline(piece, series_color(index), 2);
      piece.clear();
    };
    for (const Point& p : series.points) {
      if (!shown(series, p)) {
        flush();
        continue;
      }
      piece.push_back(place(series, p));
      all.push_back(piece.back());
    }
    flush();
    if (all.size() > kMostMarkers) return;
    for (const Point& p : all) draw_marker(svg_, p, index);
  }

  const LineChart& chart_;
  Svg svg_;
  bool has_right_ = false;
  int bar_series_ = 0;
  AxisScale x_, y_, right_;
  double left_ = 0, end_ = 0, top_ = 0, bottom_ = 0;  ///< edges of the plot
};

}  // namespace

std::string svg_text(const LineChart& chart) { return Painter(chart).paint(); }

Status write_svg(const std::string& path, const LineChart& chart, bool overwrite) {
  return io::write_text(path, svg_text(chart), overwrite);
}

}  // namespace umbrix::plot
