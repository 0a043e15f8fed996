// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include "core/math.h"
#include "umbrix/executor.h"

namespace umbrix::detail {

/// Four floats that compilers keep in a register.
using Float4 = float __attribute__((vector_size(16)));

inline Float4 least(Float4 a, Float4 b) { return a < b ? a : b; }

/// Lower bounds, and upper bounds with the sign changed: a union is two minima. The last lane means nothing.
struct BvhBounds {
  static constexpr float kInfinity = std::numeric_limits<float>::infinity();

  Float4 lower{kInfinity, kInfinity, kInfinity, kInfinity};
  Float4 minus_upper{kInfinity, kInfinity, kInfinity, kInfinity};

  void extend(const BvhBounds& b) {
    lower = least(lower, b.lower);
    minus_upper = least(minus_upper, b.minus_upper);
  }
  Float4 extent() const { return -minus_upper - lower; }
  float area() const {
    const Float4 e = extent();
    return e[0] * e[1] + e[1] * e[2] + e[2] * e[0];
  }
};

/// A triangle's bounds. Its number is in the lane to spare, as a float that is no denormal, which could cost time.
struct BvhReference {
  BvhBounds bounds;

  BvhReference() = default;
  BvhReference(const Triangle& t, std::uint32_t id) {
    const Vec3 lower = glm::min(t.v[0], glm::min(t.v[1], t.v[2])), upper = glm::max(t.v[0], glm::max(t.v[1], t.v[2]));
    const std::uint32_t bits = id | kNormal;
    float number;
    std::memcpy(&number, &bits, sizeof number);
    bounds.lower = Float4{lower.x, lower.y, lower.z, number};
    bounds.minus_upper = Float4{-upper.x, -upper.y, -upper.z, 0};
  }

  std::uint32_t id() const {
    const float number = bounds.lower[3];
    std::uint32_t bits;
    std::memcpy(&bits, &number, sizeof bits);
    return bits & ~kNormal;
  }
  Float4 middle() const { return bounds.lower - bounds.minus_upper; }  // twice as far out as it is

 private:
  static constexpr std::uint32_t kNormal = 0x40000000u;  ///< there are at most 2^29 triangles
};

/// References from first to last, their bounds, and those of their middles.
struct BvhRange {
  std::size_t first = 0, last = 0;
  BvhBounds bounds, middles;

  std::size_t size() const { return last - first; }
  void add_middle(Float4 middle) {
    middles.lower = least(middles.lower, middle);
    middles.minus_upper = least(middles.minus_upper, -middle);
  }
  void extend(const BvhRange& other) {
    bounds.extend(other.bounds);
    middles.extend(other.middles);
  }
};

/// Cuts ranges of references, which it orders so that each part is together. The result does not depend on threads.
class BvhCutter {
 public:
  explicit BvhCutter(BvhReference* references) : references_(references) {}

  /// What one thread takes at a time.
  static constexpr std::size_t kChunk = 1u << 14;

  /// Two parts that are not empty, of a range of two or more: where a leaf costs by its rows of sixteen, at the best of
  /// some planes between middles (Wald 2007).
  void cut(const BvhRange& whole, BvhRange& low, BvhRange& high) const;

  /// The same by all threads, with room for as many references in `scratch`. Throws what the executor throws.
  void cut(const BvhRange& whole, BvhRange& low, BvhRange& high, BvhReference* scratch, const Executor* executor) const;

  /// At the middle in the order as it is, whatever that costs.
  void halve(const BvhRange& whole, BvhRange& low, BvhRange& high) const;

 private:
  BvhRange range(std::size_t first, std::size_t last) const;

  BvhReference* references_;
};

}  // namespace umbrix::detail
