// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "plot/line_chart.h"

namespace umbrix::plot {

/// The finite values that an axis has to show; on a logarithmic one, the positive ones.
struct Range {
  double low = 0, high = 0;
  bool empty = true;

  void add(double value);
};

struct Tick {
  double value;
  std::string label;  ///< empty: a tick alone
};

/// An axis that is settled: its ends, and its ticks at 1, 2 or 5 times powers of ten.
struct AxisScale {
  bool logarithmic = false;
  double low = 0, high = 1;
  std::vector<Tick> ticks;

  /// Whether `value` has a place on an axis of this kind.
  bool shows(double value) const;

  /// 0 at `low`, 1 at `high`; other numbers beyond.
  double place(double value) const;
};

/// Rounds the range outwards to ticks, of which there are about `most_ticks` at most. Ends that the axis fixes stay.
AxisScale fit_axis(const Axis& axis, Range range, int most_ticks);

}  // namespace umbrix::plot
