// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "umbrix/status.h"

namespace umbrix::app {

/// Reads frame numbers as farms write them: "1-3,5,7-20:2", or "7-20x2" for the last; each from -999999 to 999999, one
/// or more. A number that comes again is left out, the order is kept. invalid_argument says what is wrong.
Status parse_frames(const std::string& text, std::vector<int>& out);

}  // namespace umbrix::app
