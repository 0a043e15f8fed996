// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/math.h"

namespace umbrix::detail {

/// A ray like those to come, in the tree's units, cut to the tree's root; and what blocks it.
struct TrainingRay {
  float origin[3];
  float inverse[3];  ///< of the direction; finite
  float t0, t1;
  std::uint32_t first_blocker, blocker_count;

  bool meets(const Box& box) const noexcept {
    float low = t0, high = t1;
    for (int axis = 0; axis < 3; ++axis) {
      const float a = (box.lower[axis] - origin[axis]) * inverse[axis];
      const float b = (box.upper[axis] - origin[axis]) * inverse[axis];
      low = std::max(low, std::min(a, b));
      high = std::min(high, std::max(a, b));
    }
    return low <= high;
  }
};

struct TrainingRays {
  std::vector<TrainingRay> rays;
  std::vector<std::uint32_t> blockers;  ///< triangles: all that block a ray, ascending, ray after ray

  const std::uint32_t* begin_blockers(const TrainingRay& ray) const noexcept {
    return blockers.data() + ray.first_blocker;
  }
  const std::uint32_t* end_blockers(const TrainingRay& ray) const noexcept {
    return begin_blockers(ray) + ray.blocker_count;
  }
};

}  // namespace umbrix::detail
