// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace umbrix::render {

/// What the colours of a heat map stand for: the first one 0, the last one `end` and, if `clamps`, all above.
struct HeatScale {
  double end = 1;
  double step = 0.2;  ///< between ticks, from 0 on
  bool clamps = false;
  double max = 0, mean = 0;  ///< of the finite values
  std::size_t without = 0;   ///< values that are not finite
};

/// A scale to `end`; if that is 0, to the 99.5th percentile of the finite values, rounded up to a whole number of
/// steps: a few pixels with extreme values must not leave one colour for all others.
HeatScale choose_heat_scale(std::vector<float> values, double end);

}  // namespace umbrix::render
