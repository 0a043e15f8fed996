// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "index/triangle_bvh.h"

namespace umbrix::detail {

/// The box of a hierarchy's vertices as to_world places them, exactly; visits few of them. There must be one.
Box placed_bounds(const TriangleBvh& bvh, const double (&to_world)[3][4]) noexcept;

}  // namespace umbrix::detail
