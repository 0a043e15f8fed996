// SPDX-License-Identifier: Apache-2.0
// Grid and axes first, then bands, bars and lines, so that the thin is above the broad.
#include "plot/line_chart.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "plot/axis_scale.h"
#include "plot/chart_area.h"
#include "plot/series_style.h"
#include "umbrix/io/image_file.h"

namespace umbrix::plot {
namespace {

constexpr std::size_t kMostMarkers = 40;
constexpr double kBandOpacity = 0.2;

/// Draws one chart.
class Painter {
 public:
  explicit Painter(const LineChart& chart) : chart_(chart), area_(chart.width, chart.height, chart.title) {
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
    area_.draw_legend(legend());
    area_.lay_out(x_, y_, has_right_ ? &right_ : nullptr);
    area_.draw_x_axis(chart_.x.title);
    area_.draw_y_axis(chart_.y.title);
    if (has_right_) area_.draw_y_axis(chart_.right.title, true);
    for (std::size_t i = 0; i < chart_.series.size(); ++i) draw_band(i);
    std::size_t bars = 0;
    for (std::size_t i = 0; i < chart_.series.size(); ++i) {
      if (chart_.series[i].mark == Mark::bars) draw_bars(i, bars++);
    }
    area_.svg().line({area_.left(), area_.bottom()}, {area_.end(), area_.bottom()}, kInk, 1);
    for (std::size_t i = 0; i < chart_.series.size(); ++i) {
      if (chart_.series[i].mark == Mark::line) draw_line(i);
    }
    return area_.svg().document();
  }

 private:
  const AxisScale& upwards(const Series& series) const { return series.on_right_axis ? right_ : y_; }

  bool shown(const Series& series, const Point& p) const { return area_.shows(p, series.on_right_axis); }

  Point place(const Series& series, const Point& p) const { return area_.place(p, series.on_right_axis); }

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
      for (const auto& [low, high] : s.band) {
        if (kind.shows(low)) range.add(low);
        if (kind.shows(high)) range.add(high);
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

  std::vector<LegendEntry> legend() const {
    std::vector<LegendEntry> entries;
    for (std::size_t i = 0; i < chart_.series.size(); ++i) {
      const Series& series = chart_.series[i];
      if (series.name.empty()) continue;
      const bool is_bar = series.mark == Mark::bars;
      entries.push_back(
          {series.name + (series.on_right_axis ? " (right)" : ""), [i, is_bar](Svg& svg, const Point& at) {
             constexpr double kSample = LegendEntry::kSample;
             if (is_bar) return svg.rectangle(at.x - kSample / 4, at.y - 6, kSample / 2, 12, series_color(i));
             svg.line({at.x - kSample / 2, at.y}, {at.x + kSample / 2, at.y}, series_color(i), 2);
             draw_marker(svg, at, i);
           }});
    }
    return entries;
  }

  /// Where points and band have a place.
  void draw_band(std::size_t index) {
    const Series& series = chart_.series[index];
    std::vector<Point> outline, way_back;
    for (std::size_t i = 0; i < std::min(series.points.size(), series.band.size()); ++i) {
      const Point low = {series.points[i].x, series.band[i][0]}, high = {series.points[i].x, series.band[i][1]};
      if (!shown(series, low) || !shown(series, high)) continue;
      outline.push_back(place(series, low));
      way_back.push_back(place(series, high));
    }
    outline.insert(outline.end(), way_back.rbegin(), way_back.rend());
    if (outline.size() > 2) area_.svg().polygon(outline, series_color(index), kBandOpacity);
  }

  void draw_bars(std::size_t index, std::size_t place_in_group) {
    const Series& series = chart_.series[index];
    double group = area_.end() - area_.left();
    std::vector<Point> tops;
    for (const Point& p : series.points) {
      if (shown(series, p)) tops.push_back(place(series, p));
    }
    std::sort(tops.begin(), tops.end(), [](const Point& a, const Point& b) { return a.x < b.x; });
    for (std::size_t i = 1; i < tops.size(); ++i) group = std::min(group, tops[i].x - tops[i - 1].x);
    if (tops.size() == 1) group /= 4;
    const double width = 0.9 * group / static_cast<double>(bar_series_);
    const AxisScale& scale = upwards(series);
    const double height = area_.bottom() - area_.top();
    const double zero = area_.bottom() - (scale.logarithmic ? 0 : std::clamp(scale.place(0), 0.0, 1.0) * height);
    for (const Point& p : tops) {
      const double x = p.x - 0.45 * group + width * static_cast<double>(place_in_group);
      area_.svg().rectangle(x, std::min(p.y, zero), width, std::abs(zero - p.y), series_color(index));
    }
  }

  void draw_line(std::size_t index) {
    const Series& series = chart_.series[index];
    std::vector<Point> piece, all;
    const auto flush = [&] {
      if (piece.size() > 1) area_.svg().polyline(piece, series_color(index), 2);
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
    for (const Point& p : all) draw_marker(area_.svg(), p, index);
  }

  const LineChart& chart_;
  ChartArea area_;
  bool has_right_ = false;
  int bar_series_ = 0;
  AxisScale x_, y_, right_;
};

}  // namespace

std::string svg_text(const LineChart& chart) { return Painter(chart).paint(); }

Status write_svg(const std::string& path, const LineChart& chart, bool overwrite) {
  return io::write_text(path, svg_text(chart), overwrite);
}

}  // namespace umbrix::plot
