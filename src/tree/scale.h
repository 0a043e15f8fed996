// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/array_view.h"
#include "core/math.h"

namespace umbrix::detail {

/// The exponent of the power of two that brings the largest coordinate of a box that is not empty into [0.5, 1).
int scale_exponent(const Box& bounds);

/// The triangle times 2^exponent.
Triangle scaled(const Triangle& triangle, int exponent);

/// All triangles times 2^exponent: exact, but for coordinates 2^126 times smaller than the largest.
std::vector<Triangle> scaled(ArrayView<Triangle> triangles, int exponent);

}  // namespace umbrix::detail
