// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/math.h"

namespace umbrix::detail {

/// The bounds of the part of the triangle inside the cell grown by `margin` on all sides, rounded outward;
/// empty if there is none.
Box clipped_bounds(const Triangle& triangle, const Box& cell, double margin) noexcept;

/// The area of the part of the triangle inside the cell.
double clipped_area(const Triangle& triangle, const Box& cell) noexcept;

/// A float at least `by` below or above x, and hardly more.
float down_by(float x, float by) noexcept;
float up_by(float x, float by) noexcept;

/// The box moved outward by at least `by` on all sides.
Box grown(const Box& box, float by) noexcept;

}  // namespace umbrix::detail
