// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace umbrix::bench {

/// A value and where it lies: an interval's ends, or the quartiles around a median.
struct Estimate {
  double value = 0, low = 0, high = 0;
};

/// The share that was seen `count` times in `trials` independent trials, with the 95 % interval of Clopper & Pearson
/// (1934), which is at least as wide as it must be. 0 within [0, 1] if there were none.
Estimate share_of(std::uint64_t count, std::uint64_t trials);

/// The median and the quartiles, linear between the values (type 7 of Hyndman & Fan 1996); zeros if there are none.
Estimate median_and_quartiles(std::vector<double> values);

/// The mean with the 95 % interval of Student's t; `other_variance` is that of what all values share.
/// Of one value the interval is infinite.
Estimate mean_interval(const std::vector<double>& values, double other_variance = 0);

}  // namespace umbrix::bench
