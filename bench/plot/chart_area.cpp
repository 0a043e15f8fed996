// SPDX-License-Identifier: Apache-2.0
#include "plot/chart_area.h"

#include <algorithm>

namespace umbrix::plot {
namespace {

double widest_label(const AxisScale& scale) {
  double width = 0;
  for (const Tick& tick : scale.ticks) width = std::max(width, text_width(tick.label));
  return width;
}

}  // namespace

double text_width(const std::string& text, double size) { return 0.63 * size * static_cast<double>(text.size()); }

ChartArea::ChartArea(int width, int height, const std::string& title)
    : width_(width), height_(height), svg_(width, height), top_(kPad) {
  svg_.rectangle(0, 0, width, height, kPaper);
  if (title.empty()) return;
  svg_.text({width / 2.0, top_ + kTitleSize}, title, Anchor::middle, kTitleSize);
  top_ += kTitleSize + kPad;
}

void ChartArea::draw_legend(const std::vector<LegendEntry>& entries) {
  constexpr double kSample = LegendEntry::kSample;
  double x = 2 * kPad, y = top_;
  bool any = false;
  for (const LegendEntry& entry : entries) {
    const double width = kSample + 6 + text_width(entry.name) + kLine;
    if (any && x + width > width_) {
      x = 2 * kPad;
      y += kLine;
    }
    const double middle = y + kLine / 2;
    entry.draw(svg_, {x + kSample / 2, middle});
    svg_.text({x + kSample + 6, middle + 0.35 * kTextSize}, entry.name, Anchor::start, kTextSize);
    x += width;
    any = true;
  }
  if (any) top_ = y + kLine;
}

void ChartArea::lay_out(const AxisScale& x, const AxisScale& y, const AxisScale* right, double strip) {
  x_ = &x;
  y_ = &y;
  right_ = right;
  top_ += kPad;
  x_axis_at_ = height_ - kPad - 2 * kLine - kTickLength;
  bottom_ = x_axis_at_ - strip;
  left_ = kPad + kLine + widest_label(y) + kTickLength + 4;
  end_ = width_ - (right ? kPad + kLine + widest_label(*right) + kTickLength + 4 : 2 * kPad);
}

void ChartArea::draw_x_axis(const std::string& title) {
  for (const Tick& tick : x_->ticks) {
    const double x = left_ + x_->place(tick.value) * (end_ - left_);
    svg_.line({x, x_axis_at_}, {x, x_axis_at_ + (tick.label.empty() ? 0.6 : 1) * kTickLength}, kInk, 1);
    svg_.text({x, x_axis_at_ + kTickLength + kTextSize + 2}, tick.label, Anchor::middle, kTextSize);
  }
  svg_.text({(left_ + end_) / 2, height_ - kPad}, title, Anchor::middle, kTextSize);
}

void ChartArea::draw_y_axis(const std::string& title, bool on_right) {
  const AxisScale& scale = upwards(on_right);
  const double x = on_right ? end_ : left_, outwards = on_right ? 1 : -1;
  for (const Tick& tick : scale.ticks) {
    const double y = bottom_ - scale.place(tick.value) * (bottom_ - top_);
    if (!on_right) svg_.line({left_, y}, {end_, y}, kGrid, 1);
    svg_.line({x, y}, {x + outwards * (tick.label.empty() ? 0.6 : 1) * kTickLength, y}, kInk, 1);
    svg_.text({x + outwards * (kTickLength + 4), y + 0.35 * kTextSize}, tick.label,
              on_right ? Anchor::start : Anchor::end, kTextSize);
  }
  svg_.line({x, top_}, {x, bottom_}, kInk, 1);
  const Point at = {on_right ? width_ - kPad - 4 : kPad + kTextSize, (top_ + bottom_) / 2};
  svg_.text(at, title, Anchor::middle, kTextSize, on_right ? 90 : -90);
}

Point ChartArea::place(const Point& p, bool on_right) const {
  return {left_ + x_->place(p.x) * (end_ - left_), bottom_ - upwards(on_right).place(p.y) * (bottom_ - top_)};
}

bool ChartArea::shows(const Point& p, bool on_right) const {
  const AxisScale& scale = upwards(on_right);
  if (!x_->shows(p.x) || !scale.shows(p.y)) return false;
  const double x = x_->place(p.x), y = scale.place(p.y);
  constexpr double kEdge = 1e-9;
  return x >= -kEdge && x <= 1 + kEdge && y >= -kEdge && y <= 1 + kEdge;
}

}  // namespace umbrix::plot
