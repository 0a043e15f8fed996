// SPDX-License-Identifier: Apache-2.0
#include "render/sampling/directions.h"

#include <algorithm>
#include <cmath>

namespace umbrix::render {

// Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
Frame3::Frame3(const Vec3& normal) : z(normal) {
  const double sign = std::copysign(1.0, z.z);
  const double a = -1 / (sign + z.z);
  const double b = z.x * z.y * a;
  x = Vec3(1 + sign * z.x * z.x * a, sign * b, -sign * z.x);
  y = Vec3(b, sign + z.y * z.y * a, -z.y);
}

// Malley's method on the concentric disk of Shirley & Chiu 1997, which keeps strata compact.
Vec3 cosine_hemisphere(const SamplePoint& u) {
  const double a = 2 * u.x - 1, b = 2 * u.y - 1;
  if (a == 0 && b == 0) return Vec3(0, 0, 1);
  const bool wide = std::abs(a) > std::abs(b);
  const double radius = wide ? a : b;
  const double angle = wide ? kPi / 4 * (b / a) : kPi / 2 - kPi / 4 * (a / b);
  const double height = std::sqrt(std::max(1 - radius * radius, 0.0));
  return Vec3(radius * std::cos(angle), radius * std::sin(angle), height);
}

}  // namespace umbrix::render
