// SPDX-License-Identifier: Apache-2.0
#include "cloth.h"

#include <algorithm>
#include <cmath>

#include "numbers.h"

namespace umbrix::scenes {

using glm::dvec3;

namespace {

/// How cloth lies that is `s` from the middle of something `half` wide: how far out, and how far below the top.
struct Drape {
  double out, drop;
};
Drape drape(double s, double half) {
  const double over = std::abs(s) - half, side = s < 0 ? -1 : 1;
  constexpr double kBend = 0.1;
  if (over < 0) return {s, 0};
  const double bent = std::min(over / kBend, 1.0), hanging = std::max(over - kBend, 0.0);
  return {side * (half + 0.06 * bent * (2 - bent) + 0.2 * hanging), 0.06 * bent * bent + hanging};
}

}  // namespace

Shape cushion(const dvec3& half_size, std::uint32_t seed) {
  Shape shape = sphere(1, 48, 24);
  for (dvec3& p : shape.positions) {
    const double wrinkle = 1 + 0.07 * noise(4 * p.x, 4 * p.z, seed);
    p = half_size * dvec3(p.x * (1.5 - 0.5 * p.x * p.x), p.y * wrinkle, p.z * (1.5 - 0.5 * p.z * p.z));
  }
  return shape;
}

Shape cloth_over(const dvec3& mattress, double width, double begin, double end, double lift, double folds, int columns,
                 int rows) {
  const Surface face = [=](double u, double v) {
    const double s = width * (u - 0.5), t = begin + (end - begin) * (1 - v);
    const Drape across = drape(s, mattress.x), along = drape(t, mattress.z);
    const double drop = std::max(across.drop, along.drop);
    const double ridge = 1 - std::abs(noise(2.2 * s + 1.3 * t, 1.6 * t - 0.8 * s, 21));
    const double crease = folds * (ridge * ridge * ridge + 0.4 * noise(5 * s, 5 * t, 4));
    // A corner hangs in one fold; waves from both sides would turn it inside out.
    const double wave = 2.2 * folds * std::max(0.0, 1 - 10 * std::min(across.drop, along.drop));
    return dvec3(across.out + wave * across.drop * sin_turns(2.6 * t + 0.4 * noise(2 * t, 0, 9)) * (s < 0 ? -1 : 1),
                 mattress.y + lift - drop + crease * std::max(0.0, 1 - 5 * drop),
                 along.out + wave * along.drop * sin_turns(2.9 * s));
  };
  return slab(columns, rows, face,
              [=](double u, double v) { return face(u, v) - dvec3(0.012 * (2 * u - 1), 0.02, 0.006); });
}

}  // namespace umbrix::scenes
