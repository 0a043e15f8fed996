// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/math.h"

namespace umbrix::detail {

/// How rays are taken into the space of a prototype's boxes, and by how much boxes must grow there so that none is
/// missed: docs/instances.md has the proof. Only boxes are tested there, so this changes time, never answers.
struct LocalFrame {
  double inverse[3][3];   ///< about that of the transform
  double translation[3];  ///< the transform's
  double norm[3];         ///< of the inverse's rows: sums of magnitudes, or a little more
  double growth[3];       ///< for rays that start at 0; kOriginGrowth * norm * the origin's largest coordinate is added

  static constexpr double kOriginGrowth = 0x1p-48;
  /// A direction's component that is smaller, relative to norm * the largest one of the world's, is taken for this.
  static constexpr double kLeastSlope = 0x1p-50;
};

/// Of vertices within `bounds` that to_world places as placed() does. False if there is no such frame, or none in which
/// boxes would be of use: the transform flattens, is out of a range in which double neither over- nor underflows, or
/// moves so far that float leaves little of the shape.
bool make_local_frame(const double (&to_world)[3][4], const Box& bounds, LocalFrame& out) noexcept;

/// Of vertices that are not moved but scaled by 2^exponent to within 1.
LocalFrame scaled_frame(int exponent) noexcept;

}  // namespace umbrix::detail
