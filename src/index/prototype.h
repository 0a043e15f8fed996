// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/math.h"
#include "index/triangle_bvh.h"
#include "umbrix/executor.h"

namespace umbrix::detail {

/// A mesh that instances share, and its hierarchy of boxes, in units of its own: times 2^exponent, so that the largest
/// coordinate is in [0.5, 1).
class Prototype {
 public:
  /// Throws std::bad_alloc.
  explicit Prototype(std::vector<Triangle> triangles);

  /// Makes the hierarchy and lets go of the triangles. Throws what TriangleBvh throws.
  void build(const Executor* executor);

  /// As they were given; until it is built.
  const std::vector<Triangle>& triangles() const noexcept { return triangles_; }
  std::size_t triangle_count() const noexcept { return triangle_count_; }
  std::size_t nonfinite_count() const noexcept { return triangle_count_ - kept_count_; }

  const TriangleBvh& bvh() const noexcept { return bvh_; }
  int exponent() const noexcept { return exponent_; }
  /// Of the finite triangles, in its units.
  const Box& bounds() const noexcept { return bounds_; }
  /// Are the units without loss? Else its instances can be placed only one by one.
  bool is_exact() const noexcept { return is_exact_; }

 private:
  std::vector<Triangle> triangles_;
  std::size_t triangle_count_ = 0, kept_count_ = 0;
  TriangleBvh bvh_;
  Box bounds_;
  int exponent_ = 0;
  bool is_exact_ = true;
};

}  // namespace umbrix::detail
