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

#include "core/float_mode.h"
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
      : scene_(scene),
        rays_(rays),
        bvh_(bvh),
        scratch_(scratch),
        filter_(scene, rays.mask),
        plain_(!rays.skip && filter_.passes_all()) {}

  /// The rays of shafts that may meet very much had better walk alone.
  template <class Alone>
  void trace(Alone&& alone) {
    sort_meetings();
    for (std::uint32_t i = 0; i < scratch_.shafts.size(); ++i) {
      const Shaft& shaft = scratch_.shafts[i];
      const std::uint32_t first = scratch_.counts[i], last = scratch_.counts[i + 1];
      if (HWY_UNLIKELY(last - first > kMostMeetings)) {
        for (std::uint32_t rest = shaft.lanes; rest != 0; rest &= rest - 1) {
          const RayBundle& b = scratch_.bundles[shaft.row * kRowLanes + first_lane(rest)];
          alone(b.first, b.count);
        }
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
    const BundleView view(bundle);
    blocked_ = ~((1u << bundle.count) - 1) & 0xFFFF;
    unsure_count_ = 0;
    const auto parts = static_cast<std::uint32_t>(scratch_.boxes.size()),
               first = favourite_ == kNone ? 0 : favourite_ / kRowLanes;
    for (std::uint32_t i = 0; i < parts && blocked_ != 0xFFFF; ++i)
      meet_part(view, i == 0 ? first : i <= first ? i - 1 : i);  // what blocked the bundle before comes first
    for (std::uint32_t i = 0; i < unsure_count_; ++i) decide(bundle, unsure_[i].id, unsure_[i].lanes);
    std::uint8_t* const out = rays_.out + bundle.first;
    for (std::uint32_t rest = blocked_ & ((1u << bundle.count) - 1); rest != 0; rest &= rest - 1)
      out[first_lane(rest)] = 1;
  }

  /// Sixteen of the meetings.
  HWY_INLINE void meet_part(const BundleView& view, std::uint32_t part) {
    const ShaftMeeting* const meetings = meetings_ + part * kRowLanes;
    const std::uint32_t here = std::min(count_ - part * kRowLanes, kRowLanes);
    alignas(64) float reach[kRowLanes];
    std::uint32_t met = view.look_at_boxes(scratch_.boxes[part], ~blocked_, reach) & ((1u << here) - 1);
    const std::uint32_t favourite = favourite_ - part * kRowLanes;
    if (favourite < kRowLanes && (met >> favourite & 1) != 0) {
      met &= ~(1u << favourite);
      meet_rows(view, meetings[favourite], meetings[favourite].lanes, reach[favourite]);
      if (blocked_ == 0xFFFF) return;
    }
    // All rows before any: a branch on each would be a guess that is often wrong.
    std::uint32_t passed[kRowLanes], lanes[kRowLanes], count = 0;
    for (; met != 0; met &= met - 1) {
      const std::uint32_t i = first_lane(met);
      passed[count] = i;
      lanes[count] = view.pass(bvh_.rows(meetings[i].rows), ~blocked_) & meetings[i].lanes;
      count += lanes[count] != 0 ? 1 : 0;
    }
    for (std::uint32_t k = 0; k < count && blocked_ != 0xFFFF; ++k) {
      const std::uint32_t before = blocked_;
      meet_rows(view, meetings[passed[k]], lanes[k], reach[passed[k]]);
      if (blocked_ != before) favourite_ = part * kRowLanes + passed[k];
    }
  }

  HWY_INLINE void meet_rows(const BundleView& view, const ShaftMeeting& m, std::uint32_t wanted, float reach) {
    const TriangleRows& rows = bvh_.rows(m.rows);
    const SeenLanes seen = view.look(rows, wanted, reach, seen_);
    if (seen.met == 0) return;
    if (plain_ && (seen.blocks & seen.met) != 0 && !view.bundle().has_begin) {
      blocked_ = 0xFFFF;
      return;
    }
    for (std::uint32_t rest = seen.met; rest != 0; rest &= rest - 1) {
      const std::uint32_t lane = first_lane(rest);
      const RayHits hits = view.meet(seen_, lane, (seen.edge_on >> lane & 1) != 0);
      if ((hits.hit | hits.unsure) == 0) continue;
      if (HWY_LIKELY(plain_)) {
        blocked_ |= hits.hit;
        if (blocked_ == 0xFFFF) return;
      } else {
        admit(view.bundle(), rows.id[lane], hits.hit & ~blocked_);
      }
      if (HWY_UNLIKELY((hits.unsure & ~blocked_) != 0)) note_unsure(view.bundle(), rows.id[lane], hits.unsure);
    }
  }

  /// Other triangles may yet block these rays for certain.
  void note_unsure(const RayBundle& bundle, std::uint32_t id, std::uint32_t lanes) {
    if (unsure_count_ == kMostUnsure)
      decide(bundle, id, lanes);
    else
      unsure_[unsure_count_++] = {id, lanes};
  }

  HWY_NOINLINE void decide(const RayBundle& bundle, std::uint32_t id, std::uint32_t lanes) {
    NoCounts none;
    for (std::uint32_t rest = lanes & ~blocked_; rest != 0; rest &= rest - 1) {
      const std::size_t i = bundle.first + first_lane(rest);
      if (rays_.skip) filter_.set_skip(rays_.skip[i]);
      if (blocks(scene_, filter_, rays_.rays[i], id, none)) blocked_ |= rest & (0u - rest);
    }
  }

  HWY_NOINLINE void admit(const RayBundle& bundle, std::uint32_t id, std::uint32_t lanes) {
    for (std::uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
      const std::size_t i = bundle.first + first_lane(rest);
      if (rays_.skip) filter_.set_skip(rays_.skip[i]);
      if (filter_.admits(id) && filter_.is_opaque(rays_.rays[i], id)) blocked_ |= rest & (0u - rest);
    }
  }

  struct Unsure {
    std::uint32_t id, lanes;
  };
  static constexpr std::uint32_t kMostUnsure = 32, kMostMeetings = 256, kNone = ~0u;

  const SceneView& scene_;
  const GroupRays& rays_;
  const TriangleBvh& bvh_;
  ShaftScratch& scratch_;
  Filter filter_;
  bool plain_;
  const ShaftMeeting* meetings_ = nullptr;  ///< of the shaft
  std::uint32_t count_ = 0, blocked_ = 0, favourite_ = 0;
  Unsure unsure_[kMostUnsure];
  std::uint32_t unsure_count_ = 0;
  SeenTriangles seen_;
};

/// One call's rays.
class ShaftTrace {
 public:
  ShaftTrace(const SceneView& scene, const LightViewTable& table) : scene_(scene), table_(table) {}

  /// Answers all rays: those that are not for it by other(first, count), those that go all ways from a point by
  /// alone(first, count). False, with no answer of use, if there are few, they do not come in bundles, or there is no
  /// memory.
  template <class Other, class Alone>
  bool trace(const GroupRays& rays, Other&& other, Alone&& alone) {
    if (rays.rays.count < kFewestRays || table_.bvh().empty()) return false;
    if (std::abs(scene_.tree->scale_exponent) > kMostScale || !comes_in_bundles(rays.rays)) return false;
    const DefaultFloatMode mode;
    try {
      std::unique_ptr<LightViewScratch> scratch = table_.borrow();
      trace(rays, scratch->shafts, other, alone);
      table_.give_back(std::move(scratch));
      return true;
    } catch (const std::bad_alloc&) {
      return false;
    }
  }

 private:
  static constexpr std::size_t kFewestRays = 64;
  static constexpr int kMostScale = 60;
  static constexpr std::size_t kMostMet = 64;

  /// After batches that shafts were not for, some are not tried: twice as many each time.
  class Patience {
   public:
    bool is_waiting() {
      if (waiting_ == 0) return false;
      --waiting_;
      return true;
    }
    void note(bool is_good) {
      wait_ = is_good ? 0 : std::min(2 * wait_ + 1, kMostWait);
      waiting_ = wait_;
    }

   private:
    static constexpr std::uint32_t kMostWait = 15;
    std::uint32_t wait_ = 0, waiting_ = 0;
  };

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

  template <class Other, class Alone>
  void trace(const GroupRays& rays, ShaftScratch& scratch, Other&& other, Alone&& alone) {
    const BundleReader reader(*scene_.tree, rays.rays);
    ShaftCutter cutter(scratch.bundles, scratch.shafts, scratch.wide);
    ShaftWalk walk(table_.bvh(), scratch);
    ShaftPackets packets(scene_, rays, table_.bvh(), scratch);
    scratch.bundles.resize(kBatchBundles);
    std::memset(rays.out, 0, rays.rays.count);
    Patience patience;
    for (std::size_t next = 0; next < rays.rays.count;) {
      const std::size_t first = next;
      if (patience.is_waiting()) {
        next = std::min(rays.rays.count, first + kBatchBundles * kRowLanes);
        alone(first, next - first);
        continue;
      }
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
      scratch.shafts.clear();
      scratch.wide.clear();
      for (std::uint32_t row = 0; row * kRowLanes < count; ++row)
        cutter.cut_row(row, std::min(kRowLanes, count - row * kRowLanes));
      for (const std::uint32_t i : scratch.wide) alone(scratch.bundles[i].first, scratch.bundles[i].count);
      const bool is_good = walk.walk(kMostMet * count);
      if (is_good)
        packets.trace(alone);
      else
        alone(first, next - first);
      patience.note(is_good && 4 * scratch.wide.size() < 3 * count);
    }
  }

  const SceneView& scene_;
  const LightViewTable& table_;
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
