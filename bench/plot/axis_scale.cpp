// SPDX-License-Identifier: Apache-2.0
#include "plot/axis_scale.h"

#include <algorithm>
#include <cmath>

#include "render/round_ticks.h"

namespace umbrix::plot {
namespace {

// Values that differ from a tick by rounding alone are on it.
constexpr double kSlack = 1e-9;

void fit_linear(AxisScale& scale, const Axis& axis, int most_ticks) {
  if (!(scale.high > scale.low)) scale.high = scale.low + (scale.low == 0 ? 1 : std::abs(scale.low));
  const double step = render::round_step(scale.high - scale.low, most_ticks);
  if (!axis.low) scale.low = std::floor(scale.low / step + kSlack) * step;
  if (!axis.high) scale.high = std::ceil(scale.high / step - kSlack) * step;
  const auto last = static_cast<long>(std::floor(scale.high / step + kSlack));
  for (auto i = static_cast<long>(std::ceil(scale.low / step - kSlack)); i <= last; ++i) {
    const double value = static_cast<double>(i) * step;
    scale.ticks.push_back({value, render::tick_label(value, step)});
  }
}

/// Where few decades are shown every tick has its number, else the powers of ten alone.
void fit_logarithmic(AxisScale& scale, const Axis& axis, int most_ticks) {
  if (!(scale.high > scale.low)) scale.high = scale.low * 10;
  const double first = std::floor(std::log10(scale.low) + kSlack), last = std::ceil(std::log10(scale.high) - kSlack);
  const bool all_named = 3 * (last - first) <= most_ticks;
  double below = std::pow(10, first), above = std::pow(10, last);
  std::vector<Tick> candidates;
  for (double exponent = first; exponent <= last; ++exponent) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double value = factor * std::pow(10, exponent);
      if (value <= scale.low * (1 + kSlack)) below = std::max(below, value);
      if (value >= scale.high * (1 - kSlack)) above = std::min(above, value);
      candidates.push_back({value, factor == 1 || all_named ? render::tick_label(value, value) : ""});
    }
  }
  if (!axis.low) scale.low = below;
  if (!axis.high) scale.high = above;
  for (const Tick& tick : candidates) {
    if (tick.value >= scale.low * (1 - kSlack) && tick.value <= scale.high * (1 + kSlack)) scale.ticks.push_back(tick);
  }
}

}  // namespace

void Range::add(double value) {
  low = empty ? value : std::min(low, value);
  high = empty ? value : std::max(high, value);
  empty = false;
}

bool AxisScale::shows(double value) const { return std::isfinite(value) && (!logarithmic || value > 0); }

double AxisScale::place(double value) const {
  if (logarithmic) return std::log(value / low) / std::log(high / low);
  return (value - low) / (high - low);
}

AxisScale fit_axis(const Axis& axis, Range range, int most_ticks) {
  if (range.empty) range = axis.logarithmic ? Range{1, 10, false} : Range{0, 1, false};
  AxisScale scale;
  scale.logarithmic = axis.logarithmic;
  scale.low = axis.low.value_or(range.low);
  scale.high = axis.high.value_or(range.high);
  if (axis.logarithmic) {
    fit_logarithmic(scale, axis, most_ticks);
  } else {
    fit_linear(scale, axis, most_ticks);
  }
  return scale;
}

}  // namespace umbrix::plot
