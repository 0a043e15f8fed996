// SPDX-License-Identifier: Apache-2.0
// Min-max binning (Shevtsov, Soupikov & Kapustin 2007, "Highly parallel fast kd-tree construction for interactive ray
// tracing of dynamic scenes"): a box counts in the bin of its start for the low sides, of its end for the high sides.

#include <algorithm>

#include "tree/split.h"

namespace umbrix::detail {
namespace {

constexpr int kBins = 32;

}  // namespace

Split find_split_by_bins(const Cell& cell, const SplitCost& cost) {
  Split best;
  for (int axis = 0; axis < 3; ++axis) {
    const float lower = cell.box.lower[axis];
    const float width = cell.box.upper[axis] - lower;
    const float to_bin = kBins / width;
    std::uint64_t starts[kBins] = {}, ends[kBins] = {};
    const auto bin = [&](float x) { return std::clamp(static_cast<int>((x - lower) * to_bin), 0, kBins - 1); };
    for (const Reference& r : cell.references) {
      ++starts[bin(r.box.lower[axis])];
      ++ends[bin(r.box.upper[axis])];
    }
    std::uint64_t started = 0, not_ended = cell.references.size();
    for (int i = 1; i < kBins; ++i) {
      started += starts[i - 1];
      not_ended -= ends[i - 1];
      const float plane = lower + width * (static_cast<float>(i) / kBins);
      if (!cost.admits(axis, plane)) continue;
      const double c = cost(axis, plane, started, not_ended);
      if (c < best.cost) best = {axis, plane, c, started, not_ended};
    }
  }
  return best;
}

}  // namespace umbrix::detail
