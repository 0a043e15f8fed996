// SPDX-License-Identifier: Apache-2.0
// Feltman, Lee & Fatahalian 2012, "SRDH": a split costs, for each ray, the triangles of the sides that it is sure to
// visit, and those of a side that it visits for nothing, or to be stopped, only if that side goes first:
//   no blocker:                 sure of both sides it meets;
//   blockers on one side only:  sure of that side; the other is extra if it is met;
//   blockers on both:           each side is extra.
//   cost(low first) = sure_low N_low + sure_high N_high + extra_low N_low, and high first with extra_high N_high.
#include "index/srdh_split.h"

#include <limits>
#include <tuple>

namespace umbrix::detail {
namespace {

constexpr std::uint32_t kSplits = CentreBins::kCount - 1;
/// Centres closer than this, in a scene of size 1, are taken as one.
constexpr float kLeastExtent = 0x1p-60f;

struct Tally {
  std::uint32_t sure_low = 0, sure_high = 0, extra_low = 0, extra_high = 0;
};

/// What a split would cost, by rays and by areas.
struct Cost {
  double rays = std::numeric_limits<double>::infinity(), areas = 0;

  friend bool operator<(const Cost& a, const Cost& b) noexcept {
    return std::tie(a.rays, a.areas) < std::tie(b.rays, b.areas);
  }
};

/// All splits of a node along one axis.
class AxisSplits {
 public:
  AxisSplits(const std::vector<Box>& boxes, const std::uint32_t* begin, const std::uint32_t* end,
             const CentreBins& bins)
      : boxes_(boxes), bins_(bins) {
    Box in_bin[CentreBins::kCount];
    for (const std::uint32_t* id = begin; id != end; ++id) {
      const std::uint32_t bin = bins.of(boxes[*id]);
      in_bin[bin].extend(boxes[*id]);
      ++counts_[bin];
    }
    // The first and the last bin hold something, so no side of a split is empty.
    Box low, high;
    for (std::uint32_t i = 0; i < kSplits; ++i) {
      low.extend(in_bin[i]);
      low_[i] = low;
      high.extend(in_bin[kSplits - i]);
      high_[kSplits - 1 - i] = high;
    }
  }

  /// A ray that nothing in the node blocks.
  void add_open(const TrainingRay& ray) {
    for (std::uint32_t i = first_low(ray); i < kSplits; ++i) ++tallies_[i].sure_low;
    for (std::uint32_t i = 0, end = end_high(ray); i < end; ++i) ++tallies_[i].sure_high;
  }

  void add_blocked(const TrainingRay& ray, const std::uint32_t* begin, const std::uint32_t* end) {
    std::uint32_t lowest = CentreBins::kCount, highest = 0;
    for (const std::uint32_t* id = begin; id != end; ++id) {
      const std::uint32_t bin = bins_.of(boxes_[*id]);
      lowest = std::min(lowest, bin);
      highest = std::max(highest, bin);
    }
    const std::uint32_t low_met = first_low(ray), high_met = end_high(ray);
    for (std::uint32_t i = 0; i < kSplits; ++i) {
      const bool in_low = lowest <= i, in_high = highest > i;
      Tally& tally = tallies_[i];
      tally.sure_low += in_low && !in_high;
      tally.sure_high += in_high && !in_low;
      tally.extra_low += in_high && (in_low || i >= low_met);
      tally.extra_high += in_low && (in_high || i < high_met);
    }
  }

  /// Takes the best split of this axis if it is better than `best`.
  void offer(Cost& best, SrdhSplit& split) const {
    std::uint32_t low_count = 0, count = 0;
    for (const std::uint32_t n : counts_) count += n;
    for (std::uint32_t i = 0; i < kSplits; ++i) {
      low_count += counts_[i];
      const double low = low_count, high = count - low_count;
      const Tally& tally = tallies_[i];
      const double extra_low = tally.extra_low * low, extra_high = tally.extra_high * high;
      const Cost cost{tally.sure_low * low + tally.sure_high * high + std::min(extra_low, extra_high),
                      half_area(low_[i]) * low + half_area(high_[i]) * high};
      if (!(cost < best)) continue;
      best = cost;
      split = {bins_, i, extra_high < extra_low, true};
    }
  }

 private:
  /// The first split whose low side the ray meets: low sides grow.
  std::uint32_t first_low(const TrainingRay& ray) const {
    return static_cast<std::uint32_t>(
        std::partition_point(low_, low_ + kSplits, [&](const Box& box) { return !ray.meets(box); }) - low_);
  }
  /// The first split whose high side the ray does not meet: high sides shrink.
  std::uint32_t end_high(const TrainingRay& ray) const {
    return static_cast<std::uint32_t>(
        std::partition_point(high_, high_ + kSplits, [&](const Box& box) { return ray.meets(box); }) - high_);
  }

  const std::vector<Box>& boxes_;
  CentreBins bins_;
  std::uint32_t counts_[CentreBins::kCount] = {};
  Box low_[kSplits], high_[kSplits];
  Tally tallies_[kSplits];
};

}  // namespace

SrdhSplit find_srdh_split(const std::vector<Box>& boxes, const std::uint32_t* begin, const std::uint32_t* end,
                          const TrainingRays& training, const NodeRays& rays) {
  Box centres;
  for (const std::uint32_t* id = begin; id != end; ++id) centres.extend(CentreBins::centre(boxes[*id]));
  Cost best;
  SrdhSplit split;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(centres.extent()[axis] > kLeastExtent)) continue;
    AxisSplits splits(boxes, begin, end, CentreBins(centres, axis));
    for (const std::uint32_t ray : rays.open) splits.add_open(training.rays[ray]);
    for (const NodeRays::Blocked& blocked : rays.blocked) {
      const std::uint32_t* const blockers = rays.blockers.data() + blocked.first;
      splits.add_blocked(training.rays[blocked.ray], blockers, blockers + blocked.count);
    }
    splits.offer(best, split);
  }
  return split;
}

}  // namespace umbrix::detail
