// SPDX-License-Identifier: Apache-2.0
// Rays that leave points in bundles: read into shafts, one walk for all shafts of a batch, bundles against what their
// shaft may meet. What the bounds leave open goes to the exact test.

#if defined(UMBRIX_KERNELS_SHAFT_TRACE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_SHAFT_TRACE_INL_H_
#undef UMBRIX_KERNELS_SHAFT_TRACE_INL_H_
#else
#define UMBRIX_KERNELS_SHAFT_TRACE_INL_H_
#endif

#include <hwy/highway.h>

#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <numeric>
#include <vector>

#include "core/float_mode.h"
#include "kernels/bundle_walk-inl.h"
#include "kernels/light_view.h"
#include "kernels/shaft_bundles-inl.h"
#include "kernels/shaft_cut-inl.h"
#include "kernels/shaft_packets-inl.h"
#include "kernels/shaft_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

/// Answers the bundles of shafts from what they may meet.
class ShaftPackets {
 public:
  ShaftPackets(const SceneView& scene, const GroupRays& rays, const TriangleBvh& bvh, ShaftScratch& scratch)
      : bvh_(bvh), scratch_(scratch), tree_(*scene.tree), rays_(rays.rays), answer_(scene, rays) {}

  /// Bundles of shafts that may meet very much had better walk by themselves: the scratch's `alone` takes their
  /// numbers.
  void trace() {
    sort_meetings();
    for (std::uint32_t i = 0; i < scratch_.shafts.size(); ++i) {
      const Shaft& shaft = scratch_.shafts[i];
      const std::uint32_t first = scratch_.counts[i], last = scratch_.counts[i + 1];
      if (HWY_UNLIKELY(last - first > kMostMeetings)) {
        for (std::uint32_t rest = shaft.lanes; rest != 0; rest &= rest - 1)
          scratch_.alone.push_back(shaft.row * kRowLanes + first_lane(rest));
      } else if (first != last) {
        trace_shaft(shaft, first, last);
      }
    }
  }

 private:
  void sort_meetings() {
    auto& counts = scratch_.counts;
    counts.assign(scratch_.shafts.size() + 2, 0);
    for (const ShaftMeeting& m : scratch_.meetings) ++counts[m.shaft + 2];
    for (std::size_t i = 2; i < counts.size(); ++i) counts[i] += counts[i - 1];
    scratch_.sorted.resize(scratch_.meetings.size());
    for (const ShaftMeeting& m : scratch_.meetings) scratch_.sorted[counts[m.shaft + 1]++] = m;
  }

  void trace_shaft(const Shaft& shaft, std::uint32_t first, std::uint32_t last) {
    meetings_ = &scratch_.sorted[first];
    count_ = last - first;
    scratch_.boxes.resize((count_ + kRowLanes - 1) / kRowLanes);
    for (std::uint32_t i = 0; i < scratch_.boxes.size() * kRowLanes; ++i) {
      const ShaftMeeting& m = meetings_[i < count_ ? i : 0];
      MeetingBoxes& boxes = scratch_.boxes[i / kRowLanes];
      for (std::uint32_t k = 0; k < 3; ++k) {
        boxes.lower[k][i % kRowLanes] = m.lower[k];
        boxes.upper[k][i % kRowLanes] = m.upper[k];
      }
    }
    favourite_ = kNone;
    for (std::uint32_t rest = shaft.lanes; rest != 0; rest &= rest - 1)
      meet_bundle(scratch_.bundles[shaft.row * kRowLanes + first_lane(rest)]);
  }

  void meet_bundle(const RayBundle& bundle) {
    const BundleHull hull(bundle);
    std::uint32_t met[kMostParts], rows = 0;
    const auto parts = static_cast<std::uint32_t>(scratch_.boxes.size());
    for (std::uint32_t i = 0; i < parts; ++i) {
      const std::uint32_t here = std::min(count_ - i * kRowLanes, kRowLanes);
      met[i] = hull.meets(scratch_.boxes[i].lower, scratch_.boxes[i].upper, faces_[i]) & ((1u << here) - 1);
      rows += static_cast<std::uint32_t>(hwy::PopCount(met[i]));
    }
    if (rows == 0) return;
    const BundleView view(bundle);
    answer_.start(bundle);
    const bool are_many = rows > kFewRows && walk_rays_.prepare(rays_, bundle, tree_);
    if (are_many) times_.set(bundle);
    const std::uint32_t first = favourite_ == kNone ? 0 : favourite_ / kRowLanes;
    for (std::uint32_t i = 0; i < parts && answer_.open() != 0; ++i) {
      const std::uint32_t part = i == 0 ? first : i <= first ? i - 1 : i;  // what blocked the bundle before comes first
      if (met[part] == 0) continue;
      if (are_many) met[part] = meet_alone(part, met[part]);
      meet_part(view, part, met[part]);
    }
    answer_.finish();
  }

  /// Of sixteen meetings, those that few rays meet, ray by ray. Returns the rest that some meet.
  HWY_INLINE std::uint32_t meet_alone(std::uint32_t part, std::uint32_t boxes) {
    RaysByBox rays;
    times_.by_boxes(faces_[part], boxes, answer_.open(), rays);
    std::uint32_t rest = boxes;
    for (std::uint32_t some = rest; some != 0; some &= some - 1) {
      const std::uint32_t lane = first_lane(some);
      if (hwy::PopCount(rays.of[lane]) > kFewRays) continue;
      rest &= ~(1u << lane);
      answer_.meet_alone(walk_rays_, rays.of[lane], rows_of(part, lane), faces_[part].reach[lane]);
    }
    return rest;
  }

  /// Those of sixteen meetings whose boxes are met.
  HWY_INLINE void meet_part(const BundleView& view, std::uint32_t part, std::uint32_t met) {
    const std::uint32_t favourite = favourite_ - part * kRowLanes;
    if (favourite < kRowLanes && (met >> favourite & 1) != 0) {
      met &= ~(1u << favourite);
      meet_row(view, part, favourite);
    }
    for (; met != 0 && answer_.open() != 0; met &= met - 1) {
      const std::uint32_t before = answer_.open(), lane = first_lane(met);
      meet_row(view, part, lane);
      if (answer_.open() != before) favourite_ = part * kRowLanes + lane;
    }
  }

  HWY_INLINE void meet_row(const BundleView& view, std::uint32_t part, std::uint32_t lane) {
    answer_.meet(view, rows_of(part, lane), meetings_[part * kRowLanes + lane].lanes, faces_[part].reach[lane]);
  }
  const TriangleRows& rows_of(std::uint32_t part, std::uint32_t lane) const {
    return bvh_.rows(meetings_[part * kRowLanes + lane].rows);
  }

  /// From more rows than these it pays to look which rays meet each box; more rays than those meet a row together.
  static constexpr std::uint32_t kFewRows = 4, kFewRays = 5;
  static constexpr std::uint32_t kMostMeetings = 128, kMostParts = kMostMeetings / kRowLanes, kNone = ~0u;

  const TriangleBvh& bvh_;
  ShaftScratch& scratch_;
  const Tree& tree_;
  const RaySpan& rays_;
  BundleAnswer answer_;
  BundleTimes times_;
  WalkRays walk_rays_;
  const ShaftMeeting* meetings_ = nullptr;  ///< of the shaft
  std::uint32_t count_ = 0, favourite_ = 0;
  Faces faces_[kMostParts];  ///< of the meetings' boxes, as a bundle sees them
};

/// Rays of a call, or of one of its blocks.
class ShaftTrace {
 public:
  ShaftTrace(const SceneView& scene, const LightViewTable& table, ShaftPatience& patience)
      : scene_(scene), table_(table), patience_(patience) {}

  /// Answers all rays, those that are not for it by other(first, count). False, with no answer of use, if there are
  /// few, they do not come in bundles, or there is no memory.
  template <class Other>
  bool trace(const GroupRays& rays, Other&& other) {
    if (rays.rays.count < kFewestRays || table_.bvh().empty()) return false;
    if (std::abs(scene_.tree->scale_exponent) > kMostScale || !comes_in_bundles(rays.rays)) return false;
    const DefaultFloatMode mode;
    try {
      const BorrowedScratch scratch(table_);
      trace(rays, scratch->shafts, other);
      return true;
    } catch (const std::bad_alloc&) {
      return false;
    }
  }

 private:
  static constexpr std::size_t kFewestRays = 64;
  static constexpr int kMostScale = 60;
  static constexpr std::size_t kMostMet = 16;

  /// Are there five rays from a point, or more, on average? From somewhere among n there are (n + 1) / 2 left.
  static bool comes_in_bundles(const RaySpan& rays) {
    constexpr std::size_t kSamples = 32;
    std::size_t left = 0;
    for (std::size_t sample = 0; sample < kSamples; ++sample) {
      const std::size_t first = sample * rays.count / kSamples, end = std::min(rays.count, first + kRowLanes);
      const float* const start = rays[first].origin;
      for (std::size_t i = first; i < end && std::equal(start, start + 3, rays[i].origin); ++i) ++left;
    }
    return left >= 3 * kSamples;
  }

  template <class Other>
  void trace(const GroupRays& rays, ShaftScratch& scratch, Other&& other) {
    const BundleReader reader(*scene_.tree, rays.rays);
    ShaftCutter cutter(scratch.bundles, scratch.shafts, scratch.alone);
    ShaftWalk walk(table_.bvh(), scratch);
    ShaftPackets packets(scene_, rays, table_.bvh(), scratch);
    BundleWalks walks(scene_, rays);
    std::vector<std::uint32_t>& alone = scratch.alone;
    scratch.bundles.resize(kBatchBundles);
    std::memset(rays.out, 0, rays.rays.count);
    for (std::size_t next = 0; next < rays.rays.count;) {
      std::uint32_t count = 0;
      while (count < kBatchBundles && next < rays.rays.count) {
        RayBundle& b = scratch.bundles[count];
        const bool is_good = reader.read(next, b);
        next += b.count;
        if (is_good)
          ++count;
        else
          other(b.first, b.count);
      }
      if (count == 0) continue;
      alone.clear();
      if (patience_.is_waiting() || !trace_shafts(count, scratch, cutter, walk, packets)) {
        alone.resize(count);
        std::iota(alone.begin(), alone.end(), 0u);
      }
      walks.trace(scratch.bundles, alone, other);
    }
  }

  /// Answers the first `count` bundles, but for those that go to the scratch's `alone`. False, with none answered, if
  /// shafts are not for them.
  bool trace_shafts(std::uint32_t count, ShaftScratch& scratch, ShaftCutter& cutter, ShaftWalk& walk,
                    ShaftPackets& packets) {
    scratch.shafts.clear();
    for (std::uint32_t row = 0; row * kRowLanes < count; ++row)
      cutter.cut_row(row, std::min(kRowLanes, count - row * kRowLanes));
    const bool is_good = walk.walk(kMostMet * count);
    patience_.note(is_good && 4 * scratch.alone.size() < 3 * count);
    if (is_good) packets.trace();
    return is_good;
  }

  const SceneView& scene_;
  const LightViewTable& table_;
  ShaftPatience& patience_;
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
