// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "umbrix/io/scene_file.h"

namespace umbrix::render {

using Int3 = std::array<std::int64_t, 3>;

/// A convex mesh with integer vertices below 2^19 in size, so that convexity and sides can be decided exactly.
struct ConvexMesh {
  std::vector<Int3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise from outside

  /// Is the point strictly in front of the triangle?
  bool in_front(std::size_t triangle, const Int3& point) const;

  /// Moved by `base`, then scaled by 2^exponent; the caller sees to it that floats can hold that.
  io::Mesh placed(const Int3& base, int exponent) const;
};

/// The hull by trying all triples; a face of more than three points is covered by overlapping triangles.
ConvexMesh convex_hull(const std::vector<Int3>& points);

}  // namespace umbrix::render
