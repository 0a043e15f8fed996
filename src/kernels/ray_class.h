// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "core/float_mode.h"
#include "umbrix/ray.h"

namespace umbrix::detail {

inline std::uint32_t float_bits(float x) noexcept {
  std::uint32_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}

/// |x| as an integer that grows with it; infinities and NaNs are above all finite values. Immune to flush-to-zero.
inline std::uint32_t magnitude_bits(float x) noexcept { return float_bits(x) & 0x7FFFFFFFu; }
inline constexpr std::uint32_t kInfinityBits = 0x7F800000u;
inline constexpr std::uint32_t kSmallestNormalBits = 0x00800000u;

inline std::uint32_t largest_magnitude_bits(const float (&v)[3]) noexcept {
  return std::max(magnitude_bits(v[0]), std::max(magnitude_bits(v[1]), magnitude_bits(v[2])));
}

/// Is the interval not empty? NaNs make it so. Denormal ends must count whatever the host's mode.
inline bool has_interval(const Ray& ray) noexcept {
  if (ray.tmin < ray.tmax) return true;
  const DefaultFloatMode mode;
  const volatile float tmin = ray.tmin, tmax = ray.tmax;
  return tmin < tmax;
}

/// Can the ray hit anything at all?
inline bool is_valid(const Ray& ray) noexcept {
  const std::uint32_t direction = largest_magnitude_bits(ray.direction);
  return direction != 0 && direction < kInfinityBits && largest_magnitude_bits(ray.origin) < kInfinityBits &&
         has_interval(ray);
}

/// 2^exponent, for exponents in the normal range.
inline float power_of_two(int exponent) noexcept {
  const std::uint32_t bits = static_cast<std::uint32_t>(exponent + 127) << 23;
  float x;
  std::memcpy(&x, &bits, sizeof x);
  return x;
}
inline double power_of_two_double(int exponent) noexcept {
  const std::uint64_t bits = static_cast<std::uint64_t>(exponent + 1023) << 52;
  double x;
  std::memcpy(&x, &bits, sizeof x);
  return x;
}

}  // namespace umbrix::detail
