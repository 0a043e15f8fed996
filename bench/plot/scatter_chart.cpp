// SPDX-License-Identifier: Apache-2.0
#include "plot/scatter_chart.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "plot/axis_scale.h"
#include "plot/chart_area.h"
#include "plot/label_places.h"
#include "plot/series_style.h"

namespace umbrix::plot {
namespace {

constexpr double kLane = 30, kRing = 6.5, kCap = 3;

class ScatterPainter {
 public:
  explicit ScatterPainter(const ScatterChart& chart) : chart_(chart), area_(chart.width, chart.height, chart.title) {
    Range along, upwards;
    AxisScale kind;
    kind.logarithmic = chart.y.logarithmic;
    for (const ScatterSeries& series : chart.series) {
      for (const ScatterPoint& p : series.points) {
        if (std::isfinite(p.x) && (p.x > 0 || !chart.x.logarithmic)) along.add(p.x);
        if (is_zero(p)) lanes_.insert(series.style);
        for (const double y : {p.y, p.low, p.high}) {
          if (!is_zero(p) && kind.shows(y)) upwards.add(y);
        }
      }
    }
    if (chart.zero_bound && kind.shows(*chart.zero_bound)) upwards.add(*chart.zero_bound);
    x_ = fit_axis(chart.x, along, std::max(2, chart.width / 70));
    y_ = fit_axis(chart.y, upwards, std::max(2, chart.height / 50));
  }

  std::string paint() {
    std::vector<LegendEntry> legend;
    for (const ScatterSeries& series : chart_.series) {
      if (series.name.empty()) continue;
      legend.push_back({series.name, [&series](Svg& svg, const Point& at) { draw(svg, series, at); }});
    }
    area_.draw_legend(legend);
    area_.lay_out(x_, y_, nullptr, strip_height());
    area_.draw_x_axis(chart_.x.title);
    area_.draw_y_axis(chart_.y.title);
    draw_zero_row();
    draw_zero_bound();
    for (const ScatterSeries& series : chart_.series) {
      for (const ScatterPoint& p : series.points) draw_interval(series, p);
    }
    for (const ScatterSeries& series : chart_.series) {
      for (const ScatterPoint& p : series.points) {
        if (shown(p)) draw(area_.svg(), series, place(series, p));
      }
    }
    draw_labels();
    return area_.svg().document();
  }

 private:
  bool is_zero(const ScatterPoint& p) const { return chart_.y.logarithmic && p.y == 0; }

  bool shown(const ScatterPoint& p) const { return area_.shows({p.x, is_zero(p) ? y_.low : p.y}); }

  double strip_height() const { return lanes_.empty() ? 0 : kLane * (static_cast<double>(lanes_.size()) + 0.4); }

  Point place(const ScatterSeries& series, const ScatterPoint& p) const {
    if (!is_zero(p)) return area_.place({p.x, p.y});
    const auto lane = std::distance(lanes_.begin(), lanes_.find(series.style));
    return {area_.place({p.x, y_.low}).x, area_.bottom() + kLane * (static_cast<double>(lane) + 0.9)};
  }

  static void draw(Svg& svg, const ScatterSeries& series, const Point& at) {
    if (series.hollow)
      svg.ring(at, kRing, series_color(series.style), 1.5);
    else
      draw_marker(svg, at, series.style);
  }

  void draw_zero_row() {
    Svg& svg = area_.svg();
    svg.line({area_.left(), area_.strip_bottom()}, {area_.end(), area_.strip_bottom()}, kInk, 1);
    if (lanes_.empty()) return;
    svg.line({area_.left(), area_.bottom()}, {area_.end(), area_.bottom()}, kInk, 1);
    svg.line({area_.left(), area_.bottom()}, {area_.left(), area_.strip_bottom()}, kInk, 1);
    const double middle = (area_.bottom() + area_.strip_bottom()) / 2;
    svg.text({area_.left() - kTickLength - 4, middle + 0.35 * kTextSize}, "0", Anchor::end, kTextSize);
  }

  void draw_zero_bound() {
    if (!chart_.zero_bound || !area_.shows({x_.low, *chart_.zero_bound})) return;
    const double y = area_.place({x_.low, *chart_.zero_bound}).y;
    area_.svg().dashed_line({area_.left(), y}, {area_.end(), y}, kInk, 1);
    area_.svg().text({area_.left() + 6, y - 5}, chart_.zero_note, Anchor::start, LabelPlaces::kSize);
  }

  void draw_interval(const ScatterSeries& series, const ScatterPoint& p) {
    if (is_zero(p) || !shown(p) || !(p.high > p.low)) return;
    const bool has_end = y_.shows(p.low) && p.low >= y_.low;
    const Point high = area_.place({p.x, std::min(p.high, y_.high)});
    const Point low = area_.place({p.x, has_end ? p.low : y_.low});
    const std::string color = series_color(series.style);
    area_.svg().line(low, high, color, 1);
    area_.svg().line({high.x - kCap, high.y}, {high.x + kCap, high.y}, color, 1);
    if (has_end) area_.svg().line({low.x - kCap, low.y}, {low.x + kCap, low.y}, color, 1);
  }

  void draw_labels() {
    LabelPlaces places(area_.left(), area_.top(), area_.end(), area_.strip_bottom());
    places.occupy(area_.left(), area_.bottom() - 1, area_.end(), area_.bottom() + 1);
    if (chart_.zero_bound && area_.shows({x_.low, *chart_.zero_bound})) {
      const double y = area_.place({x_.low, *chart_.zero_bound}).y;
      const double width = text_width(chart_.zero_note, LabelPlaces::kSize) + 6;
      places.occupy(area_.left(), y - 5 - LabelPlaces::kSize, area_.left() + width, y);
    }
    for (const ScatterSeries& series : chart_.series) {
      for (const ScatterPoint& p : series.points) {
        if (shown(p)) places.occupy(place(series, p), series.hollow ? kRing : 4);
      }
    }
    for (const ScatterSeries& series : chart_.series) {
      for (const ScatterPoint& p : series.points) {
        if (p.label.empty() || !shown(p)) continue;
        const auto at = places.place(place(series, p), p.label);
        if (at) area_.svg().text(*at, p.label, Anchor::start, LabelPlaces::kSize);
      }
    }
  }

  const ScatterChart& chart_;
  ChartArea area_;
  AxisScale x_, y_;
  std::set<std::size_t> lanes_;  ///< styles with points at 0
};

}  // namespace

std::string svg_text(const ScatterChart& chart) { return ScatterPainter(chart).paint(); }

}  // namespace umbrix::plot
