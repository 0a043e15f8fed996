// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace umbrix::cases {

using Float3 = std::array<float, 3>;

/// SplitMix64 (Steele, Lea & Flood 2014): the same numbers from a seed on every machine and standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits();
  /// Uniform in [0, count).
  std::size_t below(std::size_t count);
  /// Uniform in [low, high].
  float uniform(float low, float high);
  bool chance(double probability);
  /// Ten to a uniform power between the two: a size of any order of magnitude.
  float magnitude(double low_exponent, double high_exponent);
  float sign() { return (bits() & 1u) != 0 ? 1.0f : -1.0f; }
  Float3 in_cube(float half_size);
  /// Not normalised, but of a length between 0.01 and 1 and without a preferred direction.
  Float3 direction();

 private:
  std::uint64_t state_;
};

}  // namespace umbrix::cases
