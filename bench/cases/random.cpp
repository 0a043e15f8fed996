// SPDX-License-Identifier: Apache-2.0
#include "cases/random.h"

#include <cmath>

namespace umbrix::cases {

std::uint64_t Random::bits() {
  std::uint64_t z = (state_ += 0x9E3779B97F4A7C15ull);
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
  return z ^ (z >> 31);
}

std::size_t Random::below(std::size_t count) { return static_cast<std::size_t>(bits() % count); }

float Random::uniform(float low, float high) {
  const float unit = static_cast<float>(bits() >> 40) * 0x1p-24f;
  return low + (high - low) * unit;
}

bool Random::chance(double probability) { return static_cast<double>(bits() >> 11) * 0x1p-53 < probability; }

float Random::magnitude(double low_exponent, double high_exponent) {
  const double unit = static_cast<double>(bits() >> 11) * 0x1p-53;
  return static_cast<float>(std::pow(10.0, low_exponent + (high_exponent - low_exponent) * unit));
}

Float3 Random::in_cube(float half_size) {
  return {uniform(-half_size, half_size), uniform(-half_size, half_size), uniform(-half_size, half_size)};
}

Float3 Random::direction() {
  for (;;) {
    const Float3 d = in_cube(1);
    const float squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    if (squared > 1e-4f && squared <= 1) return d;
  }
}

}  // namespace umbrix::cases
