// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace umbrix::render {

/// The smallest step of 1, 2 or 5 times a power of ten that fits into `span` (> 0) at most `most` (> 0) times.
double round_step(double span, int most);

/// `value`, a multiple of `step`, with the decimals that tell it from its neighbours; very large and small
/// ones by a power of a thousand ("20e6").
std::string tick_label(double value, double step);

}  // namespace umbrix::render
