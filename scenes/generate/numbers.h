// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>

/// Numbers that are the same on every machine: the committed scenes are compared byte for byte.
namespace umbrix::scenes {

/// All coordinates are multiples of this (about a quarter of a millimetre).
inline constexpr double kGrid = 1.0 / 4096;

inline double snapped(double x, double step = kGrid) { return std::floor(x / step + 0.5) * step; }
inline glm::dvec3 snapped(const glm::dvec3& p) { return {snapped(p.x), snapped(p.y), snapped(p.z)}; }

/// The nearest number with so many decimals, 1 / `units` apart: it is printed as short as it looks.
inline double rounded(double x, double units) { return std::floor(x * units + 0.5) / units; }

/// sin(2 pi x). Taylor's series in plain arithmetic, because the last bit of std::sin differs between C libraries.
inline double sin_turns(double x) {
  double t = x - std::floor(x + 0.5);
  if (t > 0.25) t = 0.5 - t;
  if (t < -0.25) t = -0.5 - t;
  const double a = 6.283185307179586 * t;
  double term = a;
  double sum = a;
  for (int k = 2; k <= 20; k += 2) {
    term *= -a * a / (k * (k + 1));
    sum += term;
  }
  return sum;
}
inline double cos_turns(double x) { return sin_turns(x + 0.25); }

/// 32 well-mixed bits of a 32-bit value ("lowbias32", Chris Wellons 2018).
inline std::uint32_t hashed(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  return x ^ (x >> 16);
}

/// A stream of random numbers, the same for the same seed. Draw once in an expression: C++ leaves the order of two
/// open.
class Random {
 public:
  explicit Random(std::uint32_t seed) : state_(hashed(seed)) {}

  /// Uniform in [0, 1), a multiple of 2^-24.
  double next() { return (hashed(state_++) >> 8) / 16777216.0; }
  double between(double low, double high) { return low + (high - low) * next(); }
  /// Uniform in 0 .. count - 1.
  std::uint32_t below(std::uint32_t count) { return static_cast<std::uint32_t>(next() * count); }

 private:
  std::uint32_t state_;
};

/// Smooth noise in [-1, 1] with features of size 1 (Perlin's value noise on an integer lattice).
inline double noise(double x, double y, std::uint32_t seed = 0) {
  const auto corner = [&](double i, double j) {
    const auto a = static_cast<std::uint32_t>(static_cast<std::int32_t>(i));
    const auto b = static_cast<std::uint32_t>(static_cast<std::int32_t>(j));
    return (hashed(a + hashed(b + hashed(seed))) >> 8) / 8388608.0 - 1.0;
  };
  const auto eased = [](double t) { return t * t * (3 - 2 * t); };
  const double i = std::floor(x), j = std::floor(y);
  const double u = eased(x - i), v = eased(y - j);
  const double low = corner(i, j) * (1 - u) + corner(i + 1, j) * u;
  const double high = corner(i, j + 1) * (1 - u) + corner(i + 1, j + 1) * u;
  return low * (1 - v) + high * v;
}

}  // namespace umbrix::scenes
