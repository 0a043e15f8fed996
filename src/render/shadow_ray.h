// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render/lights/light.h"
#include "render/surface.h"

namespace umbrix::render {

/// From the surface to where the light comes from: to the light's own place at t = 1, not along a rounded direction of
/// unit length. It starts in front of the surface's triangle, on the side of its geometric normal.
Ray shadow_ray(const Surface& surface, const Arrival& arrival);

}  // namespace umbrix::render
