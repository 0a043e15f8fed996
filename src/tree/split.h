// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
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

/// Where a reference's box starts or ends along an axis, packed so that the order of integers is the order of the
/// sweep: by position, and at one position ends first (a box that ends on a plane is not on its far side).
class Event {
 public:
  Event() = default;
  static Event start(float position, std::uint32_t reference) noexcept { return Event(position, reference | kStart); }
  static Event end(float position, std::uint32_t reference) noexcept { return Event(position, reference); }

  float position() const noexcept {
    const std::uint32_t key = position_key();
    const std::uint32_t bits = (key & kSign) != 0 ? key ^ kSign : ~key;
    float position;
    std::memcpy(&position, &bits, sizeof position);
    return position;
  }
  /// Grows with the position; equal for equal positions.
  std::uint32_t position_key() const noexcept { return static_cast<std::uint32_t>(bits_ >> 32); }
  bool is_start() const noexcept { return (bits_ & kStart) != 0; }
  std::uint32_t reference() const noexcept { return static_cast<std::uint32_t>(bits_) & ~kStart; }

  /// The same end of the same box, where the reference has another number.
  Event renumbered(std::uint32_t reference) const noexcept {
    Event event;
    event.bits_ = (bits_ & ~std::uint64_t{~kStart}) | reference;
    return event;
  }

  friend bool operator<(const Event& a, const Event& b) noexcept { return a.bits_ < b.bits_; }

 private:
  static constexpr std::uint32_t kSign = 0x80000000u;
  static constexpr std::uint32_t kStart = 0x80000000u;

  Event(float position, std::uint32_t reference_and_start) noexcept {
    const float unsigned_zero = position + 0.0f;
    std::uint32_t bits;
    std::memcpy(&bits, &unsigned_zero, sizeof bits);
    const std::uint32_t key = (bits & kSign) != 0 ? ~bits : bits ^ kSign;
    bits_ = (std::uint64_t{key} << 32) | reference_and_start;
  }

  std::uint64_t bits_;
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
