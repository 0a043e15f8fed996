// SPDX-License-Identifier: Apache-2.0
// A beam holds a group of segments: it is the hull of the box of their starts and the box of their ends, the union of
// the boxes in between (Haines & Wallace 1991, "Shaft culling for efficient ray-traced radiosity"). On each axis it
// lies between two straight lines over the time u in [0, 1], so it goes down a KD-tree like a ray with two plane times.
// It gathers the leaves that any of its segments may meet; of these each segment then picks its own, eight boxes at a
// time.

#if defined(UMBRIX_KERNELS_BEAM_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_BEAM_INL_H_
#undef UMBRIX_KERNELS_BEAM_INL_H_
#else
#define UMBRIX_KERNELS_BEAM_INL_H_
#endif

#include <hwy/highway.h>

#include <cmath>
#include <limits>

#include "kernels/leaf_test-inl.h"
#include "kernels/walk-inl.h"
#include "kernels/wide_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

/// The part of a ray within the root, and where it starts and ends.
struct Segment {
  WalkRay ray;
  Interval within;
  alignas(16) float start[4];
  alignas(16) float end[4];

  void find_ends() {
    const Lanes4 f;
    for (std::size_t k = 0; k < 4; k += hn::Lanes(f)) {
      const auto origin = hn::Load(f, ray.origin + k), direction = hn::Load(f, ray.direction + k);
      hn::Store(hn::MulAdd(direction, hn::Set(f, within.t0), origin), f, start + k);
      hn::Store(hn::MulAdd(direction, hn::Set(f, within.t1), origin), f, end + k);
    }
  }
};

/// Leaves that hold something, with their cells. A fixed store that lists are stacked in, each behind the one it was
/// picked from; lists start at a multiple of eight and may be read up to the next one.
struct LeafList {
  static constexpr std::uint32_t kRoom = 1024;
  alignas(64) float faces[kFaces][kRoom];  ///< low sides of x, y, z, then the high ones
  BlockRun blocks[kRoom];
};

/// A list within the store.
struct LeafSpan {
  std::uint32_t first = 0, count = 0;

  std::uint32_t end() const { return (first + count + kBlockLanes - 1) / kBlockLanes * kBlockLanes; }
};

class Beam {
 public:
  /// Around the segments named, which are at least one.
  Beam(const Segment* segments, const std::uint16_t* names, std::uint32_t count, const Tree& tree) {
    const Lanes4 f;
    alignas(16) float bounds[5][4];  // of starts, of ends, and the largest coordinate of origins
    for (std::size_t k = 0; k < 4; k += hn::Lanes(f)) {
      const Segment& first = segments[names[0]];
      auto start_low = hn::Load(f, first.start + k), start_high = start_low;
      auto end_low = hn::Load(f, first.end + k), end_high = end_low;
      auto farthest = hn::Zero(f);
      for (std::uint32_t i = 0; i < count; ++i) {
        const Segment& s = segments[names[i]];
        const auto start = hn::Load(f, s.start + k), end = hn::Load(f, s.end + k);
        start_low = hn::Min(start_low, start);
        start_high = hn::Max(start_high, start);
        end_low = hn::Min(end_low, end);
        end_high = hn::Max(end_high, end);
        farthest = hn::Max(farthest, hn::Abs(hn::Load(f, s.ray.origin + k)));
      }
      hn::Store(start_low, f, bounds[0] + k);
      hn::Store(start_high, f, bounds[1] + k);
      hn::Store(end_low, f, bounds[2] + k);
      hn::Store(end_high, f, bounds[3] + k);
      hn::Store(farthest, f, bounds[4] + k);
    }
    starts_ = {{bounds[0][0], bounds[0][1], bounds[0][2]}, {bounds[1][0], bounds[1][1], bounds[1][2]}};
    ends_ = {{bounds[2][0], bounds[2][1], bounds[2][2]}, {bounds[3][0], bounds[3][1], bounds[3][2]}};
    const float largest = std::max({bounds[4][0], bounds[4][1], bounds[4][2], 1.0f});
    // The tree's eps, the rounding of starts and ends (of values up to twice the largest: coordinates within the root
    // are at most 1), and that of plane times (as for a ray: within eps). Doubled.
    const float margin = 4 * tree.eps + 0x1p-20f * largest;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      const int k = static_cast<int>(axis);
      low_[axis] = Line(starts_.lower[k] - margin, ends_.lower[k] - margin);
      high_[axis] = Line(starts_.upper[k] + margin, ends_.upper[k] + margin);
    }
  }

  /// The box of the segments' starts.
  const Box& starts() const { return starts_; }

  /// The area of the starts' box as seen along the beam, times the beam's length.
  float size() const {
    const Vec3 d = 0.5f * (ends_.lower + ends_.upper - starts_.lower - starts_.upper);
    const Vec3 e = starts_.extent();
    return std::abs(d.x) * e.y * e.z + std::abs(d.y) * e.z * e.x + std::abs(d.z) * e.x * e.y;
  }

  /// Appends the leaves that the beam meets, those near its start first on the whole; false if they are more than
  /// `most`.
  template <class Counts>
  bool gather(const WideTree& tree, LeafList& list, LeafSpan& span, std::uint32_t most, Counts& counts) const {
    struct Pending {
      const WideNode* parent;
      std::uint32_t lane;
      float t0;
    };
    Pending stack[7 * kMaxDepth + 8];
    std::uint32_t pending = 0;
    const WideNode* node = &tree.node(0);
    for (;;) {
      counts.node();
      alignas(32) float entered[kBlockLanes];
      const std::uint32_t base = pending;
      for (std::uint32_t rest = meets(node->faces, 0, entered); rest != 0; rest &= rest - 1) {
        const auto lane = static_cast<std::uint32_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(rest));
        const WideChild child(node->children[lane].load(std::memory_order_acquire));
        if (child.is_leaf()) {
          counts.leaf();
          if (span.count == most) return false;
          const std::uint32_t place = span.first + span.count++;
          for (std::uint32_t face = 0; face < kFaces; ++face) list.faces[face][place] = node->faces[face][lane];
          list.blocks[place] = child.run();
          continue;
        }
        std::uint32_t place = pending++;
        for (; place > base && stack[place - 1].t0 < entered[lane]; --place) stack[place] = stack[place - 1];
        stack[place] = {node, lane, entered[lane]};
      }
      if (pending == 0) return true;
      const Pending& next = stack[--pending];
      node = &tree.node(tree.enter(*next.parent, next.lane));
    }
  }

  /// Which of eight boxes the beam meets, whose faces start at lane `first`, and when.
  template <class Faces>
  HWY_INLINE std::uint32_t meets(const Faces& faces, std::uint32_t first, float* entered) const {
    const Lanes8 f;
    std::uint32_t lanes = 0;
    for (std::uint32_t i = 0; i < kBlockLanes; i += static_cast<std::uint32_t>(hn::Lanes(f))) {
      auto t0 = hn::Zero(f), t1 = hn::Set(f, 1.0f);
      for (std::uint32_t axis = 0; axis < 3; ++axis) {
        low_[axis].keep_below(hn::Load(f, faces[face_of(axis, true)] + first + i), t0, t1);
        high_[axis].keep_above(hn::Load(f, faces[face_of(axis, false)] + first + i), t0, t1);
      }
      lanes |= bits_of(hn::Le(t0, t1)) << i;
      hn::Store(t0, f, entered + i);
    }
    return lanes;
  }

  /// Picks the leaves of a list that this beam meets too, in their order, into a list behind it.
  template <class Counts>
  LeafSpan pick(LeafList& list, LeafSpan from, Counts& counts) const {
    LeafSpan to{from.end(), 0};
    alignas(32) float entered[kBlockLanes];
    for (std::uint32_t i = 0; i < from.count; i += kBlockLanes) {
      counts.node();
      std::uint32_t rest = meets(list.faces, from.first + i, entered);
      if (from.count - i < kBlockLanes) rest &= (1u << (from.count - i)) - 1;
      for (; rest != 0; rest &= rest - 1) {
        const std::uint32_t at = from.first + i + static_cast<std::uint32_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(rest));
        const std::uint32_t place = to.first + to.count++;
        for (std::uint32_t face = 0; face < kFaces; ++face) list.faces[face][place] = list.faces[face][at];
        list.blocks[place] = list.blocks[at];
      }
    }
    return to;
  }

 private:
  /// A coordinate over time, x(u) = start + u * slope.
  class Line {
   public:
    Line() = default;
    Line(float start, float end) : start_(start) {
      // Almost parallel to the plane: the times get beyond all others, and the line moves by less than the margin.
      float slope = end - start;
      if (std::abs(slope) < 0x1p-64f) slope = std::copysign(0x1p-64f, slope);
      inverse_ = 1 / slope;
      rises_ = slope > 0;
    }

    HWY_INLINE void keep_below(FloatVec plane, FloatVec& t0, FloatVec& t1) const { keep(plane, rises_, t0, t1); }
    HWY_INLINE void keep_above(FloatVec plane, FloatVec& t0, FloatVec& t1) const { keep(plane, !rises_, t0, t1); }

   private:
    HWY_INLINE void keep(FloatVec plane, bool before, FloatVec& t0, FloatVec& t1) const {
      const Lanes8 f;
      const auto t = hn::Mul(hn::Sub(plane, hn::Set(f, start_)), hn::Set(f, inverse_));
      if (before)
        t1 = hn::Min(t1, t);
      else
        t0 = hn::Max(t0, t);
    }

    float start_ = 0, inverse_ = 0;
    bool rises_ = true;
  };

  Box starts_, ends_;
  Line low_[3], high_[3];
};

/// Visits the leaves of a list that the segment crosses: leaf(run, t0, t1) returns true to stop.
template <class Leaf, class Counts>
HWY_INLINE bool visit_crossed(const LeafList& list, LeafSpan span, const Segment& segment, Leaf&& leaf,
                              Counts& counts) {
  Crossed crossed;
  for (std::uint32_t i = 0; i < span.count; i += kBlockLanes) {
    counts.node();
    cross_boxes(list.faces, span.first + i, segment.ray, segment.within, crossed);
    std::uint32_t rest = crossed.lanes;
    if (span.count - i < kBlockLanes) rest &= (1u << (span.count - i)) - 1;
    for (; rest != 0; rest &= rest - 1) {
      const auto lane = static_cast<std::uint32_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(rest));
      counts.node();
      counts.leaf();
      if (leaf(list.blocks[span.first + i + lane], crossed.t0[lane], crossed.t1[lane])) return true;
    }
  }
  return false;
}

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
