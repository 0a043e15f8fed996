// SPDX-License-Identifier: Apache-2.0
// Rays that leave points in bundles, as to a light of some size, and the shafts that hold neighbouring bundles: what a
// call works on.
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <vector>

#include "index/triangle_bvh.h"

namespace umbrix::detail {

/// So many bundles are answered together, of which sixteen in a row are cut into shafts.
inline constexpr std::uint32_t kBatchBundles = 256;

/// Up to sixteen rays from one point, in the tree's units. Lanes from `count` on repeat the first.
struct alignas(64) RayBundle {
  float far[3][kRowLanes];  ///< from the start to the ends
  float begin[kRowLanes];   ///< tmin over tmax
  float low[4], high[4];    ///< the ends' box, from the start; the last of each means nothing
  float start[3];
  std::uint32_t first, count;
  bool has_begin;  ///< some tmin is not 0
};

/// Bundles of a row of sixteen, and the hull of the box of their starts and that of their ends.
struct Shaft {
  std::uint32_t row;
  std::uint32_t lanes;  ///< of the row
  float start_low[3], start_high[3];
  float end_low[3], end_high[3];
  float normal[3], base;  ///< no start and no end is below normal . x = base, from the middle of the starts
  float middle[3];
  float largest;  ///< of all coordinates
};

/// On each axis, a shaft is between two lines over the time u from starts to ends. A line reaches the coordinate x at
/// u = x inverse + offset.
struct ShaftLine {
  float inverse, offset;
  bool rises;

  ShaftLine() = default;
  ShaftLine(float start, float end) {
    // Almost parallel to the plane: the times get beyond all others, and the line moves by less than its margin.
    float slope = end - start;
    if (std::abs(slope) < 0x1p-64f) slope = std::copysign(0x1p-64f, slope);
    inverse = 1 / slope;
    offset = -start * inverse;
    rises = slope > 0;
  }
};

/// Sixteen shafts side by side.
struct alignas(64) ShaftRows {
  float inverse[2][3][kRowLanes], offset[2][3][kRowLanes];  ///< of low and high lines
  float normal[3][kRowLanes], base[kRowLanes];              ///< in the tree's coordinates
  std::uint32_t rises[2][3];                                ///< lanes
};

/// Lanes of a row of triangles that a shaft's rays may meet.
struct ShaftMeeting {
  std::uint32_t shaft, rows, lanes;
  float lower[3], upper[3];  ///< the row's box
};

/// The boxes of sixteen meetings side by side.
struct alignas(64) MeetingBoxes {
  float lower[3][kRowLanes], upper[3][kRowLanes];
};

/// After batches that shafts were not for, some are not tried: twice as many each time. Of a call; any threads, that of
/// one may be lost to another's.
class ShaftPatience {
 public:
  bool is_waiting() noexcept {
    const std::uint32_t waiting = waiting_.load(std::memory_order_relaxed);
    if (waiting != 0) waiting_.store(waiting - 1, std::memory_order_relaxed);
    return waiting != 0;
  }
  void note(bool is_good) noexcept {
    const std::uint32_t wait = is_good ? 0 : std::min(2 * wait_.load(std::memory_order_relaxed) + 1, kMostWait);
    wait_.store(wait, std::memory_order_relaxed);
    waiting_.store(wait, std::memory_order_relaxed);
  }

 private:
  static constexpr std::uint32_t kMostWait = 15;
  std::atomic<std::uint32_t> wait_{0}, waiting_{0};
};

/// Memory of one call, used again by the next.
struct ShaftScratch {
  std::vector<RayBundle> bundles;
  std::vector<Shaft> shafts;
  std::vector<std::uint32_t> alone;  ///< bundles that walk by themselves
  std::vector<ShaftRows> rows;
  std::vector<std::uint64_t> lists;  ///< of the walk: rows of shafts and lanes
  /// A leaf that shafts meet: those of `leaf_lists` up to `end`.
  struct Leaf {
    std::size_t end;
    ShaftMeeting meeting;  ///< of any shaft
  };
  std::vector<Leaf> leaves;
  std::vector<std::uint64_t> leaf_lists;
  std::vector<ShaftMeeting> meetings, sorted;
  std::vector<MeetingBoxes> boxes;
  std::vector<std::uint32_t> counts;  ///< for counting sorts

  std::uint64_t bytes() const noexcept {
    return bundles.capacity() * sizeof(RayBundle) + 2 * meetings.capacity() * sizeof(ShaftMeeting) +
           (lists.capacity() + leaf_lists.capacity()) * sizeof(std::uint64_t) + leaves.capacity() * sizeof(Leaf);
  }
};

}  // namespace umbrix::detail
