// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render/lights/light.h"
#include "render/surface.h"

namespace umbrix::render {

/// The surface point as lights need it.
Receiver receiver_at(const Surface& surface);

/// Fills `ray`: from the surface to the light, to the light's own place, not along a rounded direction of unit length.
/// Its end is on the side of the light that shines, by the rounding error of the end, so that what the light is part
/// of, or lies on, does not shadow it; whatever is further in front does.
void find_shadow_ray(const Receiver& receiver, const Arrival& arrival, Ray& ray);

}  // namespace umbrix::render
