// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render/heat_map/canvas.h"
#include "render/ray_route.h"

namespace umbrix::render {

/// The colour of `t`, clamped to [0, 1], in viridis: dark blue to yellow. Equal steps of t look equally large, also to
/// the colour-blind and on a grey printer.
Color viridis(double t);

/// Colours to tell the routes apart, also by the colour-blind.
Color route_color(RayRoute route);

}  // namespace umbrix::render
