// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "index/training_rays.h"

namespace umbrix::detail {

/// The training rays that meet a node's box, told apart by whether something in the node blocks them.
struct NodeRays {
  /// A ray with its blockers in this node, a run of `blockers`.
  struct Blocked {
    std::uint32_t ray, first, count;
  };

  std::vector<std::uint32_t> open;
  std::vector<Blocked> blocked;
  std::vector<std::uint32_t> blockers;
};

/// Sixteen intervals along an axis, by a box's centre.
class CentreBins {
 public:
  static constexpr std::uint32_t kCount = 16;

  CentreBins() = default;
  /// `centres` bounds what centre() gives; its extent along the axis must not vanish.
  CentreBins(const Box& centres, int axis) noexcept
      : axis_(axis),
        origin_(centres.lower[axis]),
        scale_(static_cast<float>(kCount) / (centres.upper[axis] - centres.lower[axis])) {}

  /// Twice the centre, which orders as well.
  static Vec3 centre(const Box& box) noexcept { return box.lower + box.upper; }

  std::uint32_t of(const Box& box) const noexcept {
    return std::min(kCount - 1, static_cast<std::uint32_t>((centre(box)[axis_] - origin_) * scale_));
  }

 private:
  int axis_ = 0;
  float origin_ = 0, scale_ = 0;
};

/// How to split a node: bins up to `last_low` go to the low child.
struct SrdhSplit {
  CentreBins bins;
  std::uint32_t last_low = 0;
  bool high_first = false;
  bool found = false;  ///< not if all centres coincide
};

/// The best split of some triangles for the rays; where those do not tell splits apart, by the surface area heuristic.
/// `boxes` are by triangle.
SrdhSplit find_srdh_split(const std::vector<Box>& boxes, const std::uint32_t* begin, const std::uint32_t* end,
                          const TrainingRays& training, const NodeRays& rays);

}  // namespace umbrix::detail
