// SPDX-License-Identifier: Apache-2.0
// One walk of the hierarchy for all shafts of a batch. A shaft is the hull of two boxes (Haines & Wallace 1991, "Shaft
// culling for efficient ray-traced radiosity"), the union of the boxes in between: it meets a box if at some time u in
// [0, 1] the box in between does, on all axes. Shafts have a margin of 2^-19 of their largest coordinate, 32 roundings:
// ends take 2, lines 4, times 3.

#if defined(UMBRIX_KERNELS_SHAFT_WALK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_SHAFT_WALK_INL_H_
#undef UMBRIX_KERNELS_SHAFT_WALK_INL_H_
#else
#define UMBRIX_KERNELS_SHAFT_WALK_INL_H_
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>

#include "kernels/ray_lanes-inl.h"
#include "kernels/shaft.h"
#include "kernels/shaft_test-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

/// Finds the triangles that shafts may meet.
class ShaftWalk {
 public:
  ShaftWalk(const TriangleBvh& bvh, ShaftScratch& scratch) : bvh_(bvh), scratch_(scratch) {}

  /// Fills the scratch's meetings; false if there are more than `most` of them.
  bool walk(std::size_t most) {
    most_ = most;
    tested_ = missed_ = 0;
    lay_out();
    scratch_.meetings.clear();
    auto& lists = scratch_.lists;
    lists.clear();
    const std::size_t count = scratch_.shafts.size();
    for (std::size_t first = 0; first < count; first += kRowLanes) {
      const std::size_t lanes = std::min<std::size_t>(kRowLanes, count - first);
      lists.push_back(first / kRowLanes << 32 | ((1u << lanes) - 1));
    }
    scratch_.leaves.clear();
    scratch_.leaf_lists.clear();
    visit(0, 0, lists.size(), lists.size());
    visit_leaves();
    return scratch_.meetings.size() <= most_;
  }

 private:
  static void put(const ShaftLine& line, std::uint32_t side, std::uint32_t axis, std::size_t lane, ShaftRows& rows) {
    rows.inverse[side][axis][lane] = line.inverse;
    rows.offset[side][axis][lane] = line.offset;
    rows.rises[side][axis] |= (line.rises ? 1u : 0u) << lane;
  }

  void lay_out() {
    const std::size_t count = scratch_.shafts.size();
    scratch_.rows.resize((count + kRowLanes - 1) / kRowLanes);
    tests_.clear();
    for (std::size_t i = 0; i < scratch_.rows.size() * kRowLanes; ++i) {
      const std::size_t lane = i % kRowLanes;
      ShaftRows& rows = scratch_.rows[i / kRowLanes];
      if (lane == 0) std::fill_n(&rows.rises[0][0], sizeof rows.rises / sizeof rows.rises[0][0], 0u);
      const Shaft& s = scratch_.shafts[i < count ? i : 0];
      if (i < count) tests_.emplace_back(s);
      const float margin = 0x1p-19f * s.largest;
      float base = s.base - 4 * margin;
      for (std::uint32_t k = 0; k < 3; ++k) {
        put({s.start_low[k] - margin, s.end_low[k] - margin}, 0, k, lane, rows);
        put({s.start_high[k] + margin, s.end_high[k] + margin}, 1, k, lane, rows);
        rows.normal[k][lane] = s.normal[k];
        base += s.normal[k] * s.middle[k];
      }
      rows.base[lane] = base;
    }
  }

  /// Shafts of a row that meet a child's box.
  HWY_INLINE std::uint32_t meeting(const ShaftRows& rows, const BvhNode& node, std::uint32_t child) const {
    const RayTag f;
    std::uint32_t result = 0;
    for (std::uint32_t i = 0; i < kRowLanes; i += static_cast<std::uint32_t>(hn::Lanes(f))) {
      auto t0 = hn::Zero(f), t1 = hn::Set(f, 1.0f), above = hn::Zero(f);
      for (std::uint32_t k = 0; k < 3; ++k) {
        const auto lower = hn::Set(f, node.lower[k][child]), upper = hn::Set(f, node.upper[k][child]);
        const auto low = hn::MulAdd(upper, hn::Load(f, rows.inverse[0][k] + i), hn::Load(f, rows.offset[0][k] + i));
        const auto high = hn::MulAdd(lower, hn::Load(f, rows.inverse[1][k] + i), hn::Load(f, rows.offset[1][k] + i));
        const auto low_rises = lane_mask(rows.rises[0][k] >> i), high_rises = lane_mask(rows.rises[1][k] >> i);
        t1 = hn::IfThenElse(low_rises, hn::Min(t1, low), t1);
        t0 = hn::IfThenElse(low_rises, t0, hn::Max(t0, low));
        t0 = hn::IfThenElse(high_rises, hn::Max(t0, high), t0);
        t1 = hn::IfThenElse(high_rises, t1, hn::Min(t1, high));
        const auto n = hn::Load(f, rows.normal[k] + i);
        above = hn::Add(above, hn::Max(hn::Mul(n, lower), hn::Mul(n, upper)));
      }
      result |= ray_bits(hn::And(hn::Le(t0, t1), hn::Ge(above, hn::Load(f, rows.base + i)))) << i;
    }
    return result;
  }

  /// `first` and `count` name entries of the lists, a row of shafts and lanes of it; from `top` on there is room.
  void visit(std::uint32_t index, std::size_t first, std::size_t count, std::size_t top) {
    const BvhNode& node = bvh_.node(index);
    auto& lists = scratch_.lists;
    if (lists.size() < top + kBvhWidth * count) lists.resize(2 * (top + kBvhWidth * count));
    std::size_t ends[kBvhWidth];
    for (std::uint32_t child = 0; child < kBvhWidth; ++child) ends[child] = top + child * count;
    for (std::size_t i = first; i < first + count; ++i) {
      const auto row = static_cast<std::uint32_t>(lists[i] >> 32), lanes = static_cast<std::uint32_t>(lists[i]);
      for (std::uint32_t child = 0; child < kBvhWidth; ++child) {
        const std::uint32_t met = lanes & meeting(scratch_.rows[row], node, child);
        lists[ends[child]] = static_cast<std::uint64_t>(row) << 32 | met;  // whether any is met is hard to foresee
        ends[child] += met != 0 ? 1 : 0;
      }
    }
    for (std::uint32_t child = 0; child < kBvhWidth; ++child) {
      const std::size_t list = top + child * count;
      if (ends[child] == list) continue;
      const std::uint32_t next = node.child[child];
      if (next & BvhNode::kLeaf)
        add_leaf(node, child, list, ends[child] - list);
      else
        visit(next, list, ends[child] - list, top + kBvhWidth * count);
    }
  }

  void add_leaf(const BvhNode& node, std::uint32_t child, std::size_t first, std::size_t count) {
    const auto begin = scratch_.lists.begin() + static_cast<std::ptrdiff_t>(first);
    scratch_.leaf_lists.insert(scratch_.leaf_lists.end(), begin, begin + static_cast<std::ptrdiff_t>(count));
    ShaftScratch::Leaf leaf{scratch_.leaf_lists.size(), {0, node.child[child] & ~BvhNode::kLeaf, 0, {}, {}}};
    for (std::uint32_t k = 0; k < 3; ++k) {
      leaf.meeting.lower[k] = node.lower[k][child];
      leaf.meeting.upper[k] = node.upper[k][child];
    }
    scratch_.leaves.push_back(leaf);
  }

  /// Leaves one after the other, so that their triangles can be fetched some way ahead.
  void visit_leaves() {
    constexpr std::size_t kAhead = 4;
    const auto& leaves = scratch_.leaves;
    std::size_t first = 0;
    for (std::size_t i = 0; i < leaves.size() && scratch_.meetings.size() <= most_; ++i) {
      if (i + kAhead < leaves.size() && tests_pay())
        prefetch_lines(&bvh_.rows(leaves[i + kAhead].meeting.rows), sizeof(TriangleRows));
      visit_rows(leaves[i], first);
      first = leaves[i].end;
    }
  }

  void visit_rows(const ShaftScratch::Leaf& leaf, std::size_t first) {
    const TriangleRows& rows = bvh_.rows(leaf.meeting.rows);
    auto& meetings = scratch_.meetings;
    for (std::size_t i = first; i < leaf.end; ++i) {
      const std::uint64_t entry = scratch_.leaf_lists[i];
      const auto row = static_cast<std::uint32_t>(entry >> 32), lanes = static_cast<std::uint32_t>(entry);
      std::size_t count = meetings.size();
      meetings.resize(count + hwy::PopCount(lanes));
      for (std::uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        ShaftMeeting& m = meetings[count];
        m = leaf.meeting;
        m.shaft = row * kRowLanes + first_lane(rest);
        m.lanes = 0xFFFF;
        if (tests_pay()) {
          m.lanes = tests_[m.shaft](rows) & ((1u << rows.count) - 1);
          ++tested_;
          missed_ += m.lanes == 0 ? 1 : 0;
        }
        count += m.lanes != 0 ? 1 : 0;  // whether it meets any is hard to foresee
      }
      meetings.resize(count);
    }
  }

  /// In foliage nearly all rows have something in each shaft that meets their box, and each costs a miss of the cache.
  bool tests_pay() const { return tested_ < 256 || 16 * missed_ > tested_; }

  const TriangleBvh& bvh_;
  ShaftScratch& scratch_;
  std::vector<ShaftTest> tests_;
  std::size_t most_ = 0, tested_ = 0, missed_ = 0;
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
