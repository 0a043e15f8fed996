// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/math.h"

namespace umbrix::detail {

/// Costs in units of one inner-node step. A leaf pays for each block of eight it starts and a little for each triangle.
struct CostModel {
  double block = 1.5;
  double triangle = 0.2;
  double empty_factor = 0.8;  ///< for a split that cuts off empty space (Wald & Havran 2006, section 3.2)

  double leaf(std::uint64_t triangles) const noexcept {
    const std::uint64_t blocks = (triangles + 7) / 8;
    return block * static_cast<double>(blocks) + triangle * static_cast<double>(triangles);
  }
};

/// A triangle within a cell: `box` bounds its part in the cell grown by eps, is itself grown by eps, and cut to the
/// cell.
struct Reference {
  std::uint32_t triangle;
  Box box;
};

/// Where a reference's box starts or ends along an axis. Ends come first among equals: a box that ends on a plane is
/// not on its far side.
struct Event {
  float position;
  std::uint32_t reference_and_start;

  static Event start(float position, std::uint32_t reference) noexcept { return {position, (reference << 1) | 1u}; }
  static Event end(float position, std::uint32_t reference) noexcept { return {position, reference << 1}; }
  bool is_start() const noexcept { return (reference_and_start & 1u) != 0; }
  std::uint32_t reference() const noexcept { return reference_and_start >> 1; }

  friend bool operator<(const Event& a, const Event& b) noexcept {
    if (a.position != b.position) return a.position < b.position;
    if (a.is_start() != b.is_start()) return b.is_start();
    return a.reference_and_start < b.reference_and_start;
  }
};

/// What is left to build: a cell and what it holds. `events` stay empty in the binned mode.
struct Cell {
  Box box;
  std::vector<Reference> references;
  std::array<std::vector<Event>, 3> events;
};

/// A plane and its expected cost.
struct Split {
  int axis = -1;
  float plane = 0;
  double cost = std::numeric_limits<double>::infinity();
  std::uint64_t low_count = 0;
  std::uint64_t high_count = 0;

  bool valid() const noexcept { return axis >= 0; }
};

/// The surface area heuristic for one candidate; planes nearer than `min_width` to the cell's ends are not candidates.
class SplitCost {
 public:
  SplitCost(const Box& cell, const CostModel& model, float min_width) noexcept
      : cell_(cell), model_(model), inverse_area_(1 / half_area(cell)), min_width_(min_width) {}

  bool admits(int axis, float plane) const noexcept {
    return plane - cell_.lower[axis] >= min_width_ && cell_.upper[axis] - plane >= min_width_;
  }

  double operator()(int axis, float plane, std::uint64_t low_count, std::uint64_t high_count) const noexcept {
    const DVec3 e = DVec3(cell_.upper) - DVec3(cell_.lower);
    const int u = axis == 2 ? 0 : axis + 1, v = axis == 0 ? 2 : axis - 1;
    const double cap = e[u] * e[v], rim = e[u] + e[v];
    const double low = cap + rim * (static_cast<double>(plane) - static_cast<double>(cell_.lower[axis]));
    const double high = cap + rim * (static_cast<double>(cell_.upper[axis]) - static_cast<double>(plane));
    const double cost = 1 + inverse_area_ * (low * model_.leaf(low_count) + high * model_.leaf(high_count));
    return low_count == 0 || high_count == 0 ? cost * model_.empty_factor : cost;
  }

 private:
  Box cell_;
  CostModel model_;
  double inverse_area_;
  float min_width_;
};

/// The best plane over all ends of boxes, by one sweep over the sorted events of each axis.
Split find_split_by_sweep(const Cell& cell, const SplitCost& cost);

/// The best of 31 planes an axis, from counts of box ends in 32 bins.
Split find_split_by_bins(const Cell& cell, const SplitCost& cost);

}  // namespace umbrix::detail
