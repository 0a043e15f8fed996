// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "umbrix/status.h"

namespace umbrix::plot {

/// Whether the build found librsvg and cairo.
bool can_rasterise();

/// An SVG document as a PNG file of `scale` times its pixels, which appears whole or not at all. output_failed names
/// the file; internal if can_rasterise is false.
Status write_png(const std::string& path, const std::string& svg, double scale);

}  // namespace umbrix::plot
