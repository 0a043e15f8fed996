// SPDX-License-Identifier: Apache-2.0
// The exact sweep of Wald & Havran (2006), "On building fast kd-trees for ray tracing, and on doing that in O(N log
// N)", section 4. Boxes grown by eps are never flat, so there are no planar events.

#include "tree/split.h"

namespace umbrix::detail {

Split find_split_by_sweep(const Cell& cell, const SplitCost& cost) {
  Split best;
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<Event>& events = cell.events[static_cast<std::size_t>(axis)];
    std::uint64_t started = 0;
    std::uint64_t not_ended = cell.references.size();
    for (std::size_t i = 0; i < events.size();) {
      const std::uint32_t key = events[i].position_key();
      const float plane = events[i].position();
      std::uint64_t starts = 0;
      for (; i < events.size() && events[i].position_key() == key; ++i) {
        const bool is_start = events[i].is_start();
        starts += is_start;
        not_ended -= !is_start;
      }
      if (cost.admits(axis, plane)) {
        const double c = cost(axis, plane, started, not_ended);
        if (c < best.cost) best = {axis, plane, c, started, not_ended};
      }
      started += starts;
    }
  }
  return best;
}

}  // namespace umbrix::detail
