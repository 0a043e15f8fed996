// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "plot/svg.h"

namespace umbrix::plot {

/// The colour of the chart's series number `index`; after seven they repeat, with other markers.
std::string series_color(std::size_t index);

/// Draws that series' marker: shapes differ as colours do, for those who see or print none.
void draw_marker(Svg& svg, const Point& centre, std::size_t index);

}  // namespace umbrix::plot
