// SPDX-License-Identifier: Apache-2.0
// Pharr, Jakob & Humphreys (2023), "Physically Based Rendering", section 6.8.6: move the point along the normal until
// its error box is on one side of the surface, then round each moved coordinate away from it.

#include <cmath>
#include <limits>

#include "umbrix/scene.h"

namespace umbrix {

void offset_origin(const float point[3], const float point_error[3], const float normal[3], const float toward[3],
                   float origin[3]) noexcept {
  double square = 0, reach = 0, side = 0;
  for (int k = 0; k < 3; ++k) {
    const double n = normal[k];
    square += n * n;
    reach += std::abs(n) * static_cast<double>(point_error[k]);
    side += n * static_cast<double>(toward[k]);
  }
  const double distance = square > 0 ? std::copysign(reach / square, side) : 0;
  for (int k = 0; k < 3; ++k) {
    const double offset = distance * static_cast<double>(normal[k]);
    const float moved = static_cast<float>(static_cast<double>(point[k]) + offset);
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    origin[k] = offset == 0 ? point[k] : std::nextafter(moved, offset > 0 ? kInfinity : -kInfinity);
  }
}

}  // namespace umbrix
