// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shape.h"

namespace umbrix::scenes {

/// A cushion that fills a box of the given half size, with wrinkles.
Shape cushion(const glm::dvec3& half_size, std::uint32_t seed);

/// Cloth on a mattress around the y axis, given by half its width, the height of its top and half its length. The cloth
/// is `width` across, reaches from z = begin to z = end along it, lies `lift` above, and hangs over the edges.
Shape cloth_over(const glm::dvec3& mattress, double width, double begin, double end, double lift, double folds,
                 int columns, int rows);

}  // namespace umbrix::scenes
