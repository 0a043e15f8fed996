// SPDX-License-Identifier: Apache-2.0
// One walk of the hierarchy for all groups of rays that a light has, as an irregular z-buffer draws all triangles at
// once (Johnson et al. 2005; Aila & Laine 2004): boxes are tested against groups side by side, and each row of
// triangles is prepared for the light once, for the groups that it may block.

#if defined(UMBRIX_KERNELS_LIGHT_WALK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_LIGHT_WALK_INL_H_
#undef UMBRIX_KERNELS_LIGHT_WALK_INL_H_
#else
#define UMBRIX_KERNELS_LIGHT_WALK_INL_H_
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <atomic>
#include <cstddef>

#include "kernels/light_triangles-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

/// A group's rectangle and starts against sixteen triangles.
class GroupTest {
 public:
  explicit GroupTest(const RayGroup& group) : group_(group) {}

  struct Result {
    std::uint32_t met;     ///< may block some start
    std::uint32_t blocks;  ///< surely blocks all of them
  };

  Result operator()(const LightTriangles& t, std::uint32_t wanted) const {
    const RayTag f;
    Result result{0, 0};
    const auto u = hn::Set(f, group_.u), v = hn::Set(f, group_.v);
    const auto half_u = hn::Set(f, group_.half_u), half_v = hn::Set(f, group_.half_v);
    const auto nearest = hn::Set(f, group_.nearest);
    const auto slope_u = hn::Set(f, group_.slope_u), slope_v = hn::Set(f, group_.slope_v),
               base = hn::Set(f, group_.base);
    const auto lanes = static_cast<std::uint32_t>(hn::Lanes(f));
    for (std::uint32_t i = 0; i < kRowLanes; i += lanes) {
      const std::uint32_t some = wanted >> i & ((1u << lanes) - 1);
      if (some == 0) continue;
      const std::uint32_t known = ~(t.edge_on >> i);
      // The plane first: most of what is near a group is the surface that its rays start from.
      const auto pu = hn::Load(f, t.plane[0] + i), pv = hn::Load(f, t.plane[1] + i), pw = hn::Load(f, t.plane[2] + i);
      const auto plane_error = error_bound(t.plane_error, i, group_.nearest);
      const auto du = hn::Sub(pu, slope_u), dv = hn::Sub(pv, slope_v);
      const auto before = hn::MulAdd(du, u, hn::MulAdd(dv, v, hn::Sub(pw, base)));
      const auto slack = hn::MulAdd(hn::Abs(du), half_u, hn::MulAdd(hn::Abs(dv), half_v, plane_error));
      const std::uint32_t open = some & ~(ray_bits(hn::Lt(hn::Add(before, slack), hn::Zero(f))) & known);

      const auto error = error_bound(t.edge_error, i, group_.reach);
      auto least_high = hn::Set(f, std::numeric_limits<float>::infinity()), most_low = hn::Neg(least_high);
      auto least_low = least_high;
      for (const auto& edge : t.edge) {
        const auto eu = hn::Load(f, edge[0] + i), ev = hn::Load(f, edge[1] + i);
        const auto middle = hn::MulAdd(eu, u, hn::MulAdd(ev, v, hn::Load(f, edge[2] + i)));
        const auto reach = hn::MulAdd(hn::Abs(eu), half_u, hn::MulAdd(hn::Abs(ev), half_v, error));
        const auto low = hn::Sub(middle, reach);
        least_high = hn::Min(least_high, hn::Add(middle, reach));
        most_low = hn::Max(most_low, low);
        least_low = hn::Min(least_low, low);
      }
      // Without a known side a triangle is missed if two of its edges are passed on different sides.
      const auto outside = hn::Lt(least_high, hn::Zero(f));
      const std::uint32_t apart = ray_bits(hn::And(outside, hn::Gt(most_low, hn::Zero(f))));
      const std::uint32_t met = open & ~((ray_bits(outside) & known) | (apart & ~known));
      result.met |= met << i;
      const std::uint32_t within = met & known & ray_bits(hn::Gt(least_low, hn::Zero(f)));
      if (HWY_LIKELY(within == 0)) continue;
      const auto least = hn::Sub(hn::MulAdd(pu, u, hn::MulAdd(pv, v, pw)),
                                 hn::MulAdd(hn::Abs(pu), half_u, hn::MulAdd(hn::Abs(pv), half_v, plane_error)));
      result.blocks |= (within & ray_bits(hn::Gt(least, hn::Mul(nearest, hn::Set(f, 1 + 0x1p-18f))))) << i;
    }
    return result;
  }

 private:
  const RayGroup& group_;
};

/// Is the walk of some of a call's rays in vain? Once these, or rays before them, are known to be answered otherwise,
/// with all after those.
struct GivenUp {
  const std::atomic<std::size_t>& end;  ///< of the rays that are answered so
  std::size_t begin;                    ///< of those of the walk

  bool operator()() const { return end.load(std::memory_order_relaxed) <= begin; }
};

/// Finds what the groups' rays may meet, for packets of them.
template <class Packets>
class LightWalk {
 public:
  LightWalk(const TriangleBvh& bvh, const LightPoint& light, const ViewErrors& errors, Packets& packets,
            LightViewScratch& scratch, const GivenUp& is_given_up)
      : bvh_(bvh), light_(light), errors_(errors), packets_(packets), scratch_(scratch), is_given_up_(is_given_up) {}

  /// Triangles may meet groups so many times; returns how many are left. None, if it is given up.
  std::size_t walk(std::size_t room) {
    room_ = room;
    if constexpr (kCounts) scratch_.shared.assign(scratch_.group_count(), {});
    first_group_ = 0;
    for (std::uint32_t number = 0; number < kViewFaces; ++number) {
      auto& groups = scratch_.faces[number];
      if (groups.groups.empty()) continue;
      lay_out(groups);
      Here here{Face(number), groups};
      auto& lists = scratch_.lists;
      lists.clear();
      for (std::uint32_t row = 0; row < groups.rows.size(); ++row)
        lists.push_back(static_cast<std::uint64_t>(row) << 32 | groups.live[row]);
      visit(here, 0, 0, lists.size(), lists.size());
      while (waiting_count_ > 0) visit_waiting(here);
      if (room_ == 0 || is_given_up_()) return 0;
      first_group_ += static_cast<std::uint32_t>(groups.groups.size());
    }
    return room_;
  }

 private:
  static constexpr bool kCounts = Packets::kCounts;
  /// Meets no group.
  static constexpr ViewBox kNothing{1, -1, 1, -1, -1};

  struct Here {
    Face face;
    LightViewScratch::FaceGroups& groups;
  };

  /// Lays groups side by side in the order in which they came, with the margins that all rays have together.
  void lay_out(LightViewScratch::FaceGroups& face) {
    for (RayGroup& g : face.groups) {
      g.half_u += 0x1p-20f + 2 * errors_.start;
      g.half_v += 0x1p-20f + 2 * errors_.start;
      const float off = 0x1p-21f + errors_.start;
      g.base -= off * (g.nearest + std::abs(g.slope_u) + std::abs(g.slope_v));
      g.farthest *= 1 - (0x1p-18f + 2 * errors_.start);
      g.nearest *= 1 + off;
      g.reach = 1 / g.farthest;
    }
    const std::size_t rows = (face.groups.size() + kRowLanes - 1) / kRowLanes;
    face.rows.resize(rows);
    face.live.assign(rows, 0);
    for (std::size_t i = 0; i < rows * kRowLanes; ++i) {
      const bool used = i < face.groups.size();
      const RayGroup& g = face.groups[used ? i : 0];
      auto& row = face.rows[i / kRowLanes].rows;
      const std::size_t lane = i % kRowLanes;
      row[ViewRows::low_u][lane] = g.u - g.half_u;
      row[ViewRows::high_u][lane] = g.u + g.half_u;
      row[ViewRows::low_v][lane] = g.v - g.half_v;
      row[ViewRows::high_v][lane] = g.v + g.half_v;
      row[ViewRows::depth][lane] = g.farthest;
      if (used) face.live[i / kRowLanes] |= 1u << lane;
    }
  }

  /// False if nothing of the box is on the face's side. A point of a segment, at depth m, is seen within 2 off / m of
  /// its start, where ends are off by up to `off` on each axis; and no deeper than the start.
  bool project(const BvhNode& node, std::uint32_t child, const Face& face, ViewBox& out) const {
    const auto low = [&](std::uint32_t axis) { return node.lower[axis][child] - light_.high[axis] - light_.low[axis]; };
    const auto high = [&](std::uint32_t axis) {
      return node.upper[axis][child] - light_.high[axis] - light_.low[axis];
    };
    const float off = errors_.most;
    const float near_m = face.sign > 0 ? low(face.axis) : -high(face.axis);
    const float far_m = (face.sign > 0 ? high(face.axis) : -low(face.axis)) + 4 * off;
    if (!(far_m > 0)) return false;
    if (near_m > 4 * off) {
      const float near_w = 1 / near_m, far_w = 1 / far_m;
      const float margin = 0x1p-18f + 2.2f * off * near_w;
      const auto least = [&](float x) { return x * (x > 0 ? far_w : near_w) - margin; };
      const auto most = [&](float x) { return x * (x > 0 ? near_w : far_w) + margin; };
      out = {least(low(face.u_axis())), most(high(face.u_axis())), least(low(face.v_axis())), most(high(face.v_axis())),
             near_w * (1 + 0x1p-18f)};
      return out.low_u <= 1 + 0x1p-18f && out.high_u >= -1 - 0x1p-18f && out.low_v <= 1 + 0x1p-18f &&
             out.high_v >= -1 - 0x1p-18f;
    }
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    // Up to the face's plane the box may cover one side of it, or all.
    const float far_w = 1 / far_m;
    const auto least = [&](float x) { return x > 0 ? x * far_w * (1 - 0x1p-18f) - 0x1p-18f : -kInfinity; };
    const auto most = [&](float x) { return x < 0 ? x * far_w * (1 - 0x1p-18f) + 0x1p-18f : kInfinity; };
    out = {least(low(face.u_axis()) - 4 * off), most(high(face.u_axis()) + 4 * off),
           least(low(face.v_axis()) - 4 * off), most(high(face.v_axis()) + 4 * off), kInfinity};
    return true;
  }

  /// `first` and `count` name entries of the lists, a row of groups and lanes of it; from `top` on there is room.
  void visit(Here& here, std::uint32_t index, std::size_t first, std::size_t count, std::size_t top) {
    const BvhNode& node = bvh_.node(index);
    if (scratch_.lists.size() < top + kBvhWidth * count) scratch_.lists.resize(2 * (top + kBvhWidth * count));
    std::uint64_t* const lists = scratch_.lists.data();
    std::uint32_t counts[kBvhWidth] = {};
    ViewBox boxes[kBvhWidth];
    for (std::uint32_t child = 0; child < kBvhWidth; ++child)
      if (!project(node, child, here.face, boxes[child])) boxes[child] = kNothing;
    for (const std::uint64_t* entry = lists + first; entry != lists + first + count; ++entry) {
      const auto row = static_cast<std::uint32_t>(*entry >> 32);
      const std::uint32_t lanes = static_cast<std::uint32_t>(*entry) & here.groups.live[row];
      if (lanes == 0) continue;
      if constexpr (kCounts) share(row, lanes, false);
      for (std::uint32_t child = 0; child < kBvhWidth; ++child) {
        const std::uint32_t met = lanes & meeting<Starts::in_rows>(here.groups.rows[row], boxes[child]);
        lists[top + child * count + counts[child]] = static_cast<std::uint64_t>(row) << 32 | met;
        counts[child] += met != 0 ? 1 : 0;  // no branch, as it would not be foreseen
      }
    }
    // What most groups meet comes first: those that it blocks are done with.
    std::uint32_t order[kBvhWidth];
    for (std::uint32_t child = 0; child < kBvhWidth; ++child) order[child] = counts[child] * kBvhWidth + child;
    sort_four(order);
    for (const std::uint32_t key : order) {
      if (key < kBvhWidth) break;
      const std::uint32_t child = key % kBvhWidth;
      const std::size_t list = top + child * count;
      if (room_ == 0 || is_given_up_()) return;
      const std::uint32_t next = node.child[child];
      if (next & BvhNode::kLeaf)
        add_leaf(here, next & ~BvhNode::kLeaf, list, list + counts[child]);
      else
        visit(here, next, list, counts[child], top + kBvhWidth * count);
    }
  }

  /// The largest first.
  static HWY_INLINE void sort_four(std::uint32_t (&x)[4]) {
    const auto order = [&x](std::uint32_t a, std::uint32_t b) {
      const std::uint32_t more = std::max(x[a], x[b]);
      x[b] = std::min(x[a], x[b]);
      x[a] = more;
    };
    order(0, 1);
    order(2, 3);
    order(0, 2);
    order(1, 3);
    order(1, 2);
  }

  /// Leaves wait for a few others, so that their triangles can be fetched.
  void add_leaf(Here& here, std::uint32_t rows, std::size_t first, std::size_t last) {
    prefetch_lines(&bvh_.rows(rows), offsetof(TriangleRows, normal));
    if (waiting_count_ == LightViewScratch::kWaitingLeaves) visit_waiting(here);
    LightViewScratch::WaitingLeaf& leaf =
        scratch_.waiting[(first_waiting_ + waiting_count_++) % LightViewScratch::kWaitingLeaves];
    leaf.rows = rows;
    leaf.list.assign(scratch_.lists.begin() + static_cast<std::ptrdiff_t>(first),
                     scratch_.lists.begin() + static_cast<std::ptrdiff_t>(last));
  }

  void visit_waiting(Here& here) {
    const LightViewScratch::WaitingLeaf& leaf = scratch_.waiting[first_waiting_];
    first_waiting_ = (first_waiting_ + 1) % LightViewScratch::kWaitingLeaves;
    --waiting_count_;
    if (room_ != 0) visit_rows(here, bvh_.rows(leaf.rows), leaf.list);
  }

  /// In turns, so that no branch depends on what has just been computed.
  void visit_rows(Here& here, const TriangleRows& rows, const std::vector<std::uint64_t>& list) {
    const TriangleLanes lanes(rows, here.face, light_, errors_);
    LightTriangles triangles;
    lanes.bound(triangles.bounds);
    const std::size_t near_count = find_near(here, triangles, (1u << rows.count) - 1, list);
    if (near_count == 0) return;
    lanes.prepare(triangles);
    const std::size_t met_count = find_met(here, triangles, near_count);
    const MetGroup* const groups = scratch_.met_groups.data();
    std::size_t count = 0;
    for (std::size_t i = 0; i < met_count; ++i)
      packets_.choose(here.groups.groups[groups[i].group], groups[i], triangles, count);
    const MetPacket* const chosen = scratch_.met_packets.data();
    for (std::size_t i = 0; i < count; ++i) {
      const MetPacket met = chosen[i];
      if (packets_.meet(here.groups.groups[met.group], triangles, met)) end(here, met.group);
    }
  }

  /// Groups whose rectangles and depths meet those of some triangles. Returns their number.
  HWY_INLINE std::size_t find_near(Here& here, const LightTriangles& triangles, std::uint32_t all,
                                   const std::vector<std::uint64_t>& list) {
    if (scratch_.met_groups.size() < kRowLanes * list.size()) scratch_.met_groups.resize(kRowLanes * list.size());
    MetGroup* const found = scratch_.met_groups.data();
    std::size_t count = 0;
    for (const std::uint64_t entry : list) {
      const auto row = static_cast<std::uint32_t>(entry >> 32);
      const std::uint32_t live = static_cast<std::uint32_t>(entry) & here.groups.live[row];
      if constexpr (kCounts) share(row, live, true);
      for (std::uint32_t rest = live; rest != 0; rest &= rest - 1) {
        const std::uint32_t lane = first_lane(rest);
        const auto& g = here.groups.rows[row].rows;
        const ViewBox box{g[ViewRows::low_u][lane], g[ViewRows::high_u][lane], g[ViewRows::low_v][lane],
                          g[ViewRows::high_v][lane], g[ViewRows::depth][lane]};
        const std::uint32_t near = all & meeting<Starts::in_box>(triangles.bounds, box);
        found[count] = {row * kRowLanes + lane, near};
        count += near != 0 ? 1 : 0;
      }
    }
    return count;
  }

  /// Leaves those whose rays triangles may block, but for groups that one of them covers. Returns their number.
  HWY_INLINE std::size_t find_met(Here& here, const LightTriangles& triangles, std::size_t near_count) {
    MetGroup* const found = scratch_.met_groups.data();
    std::size_t count = 0;
    for (std::size_t i = 0; i < near_count; ++i) {
      const MetGroup near = found[i];
      const RayGroup& group = here.groups.groups[near.group];
      const GroupTest::Result result = GroupTest(group)(triangles, near.triangles);
      if (HWY_UNLIKELY(result.blocks != 0) && packets_.is_plain()) {
        packets_.cover(group);
        end(here, near.group);
        continue;
      }
      packets_.prefetch(group);  // whether it meets any is hard to foresee
      found[count] = {near.group, result.met};
      count += result.met != 0 ? 1 : 0;
      room_ -= std::min<std::size_t>(room_, hwy::PopCount(result.met));
    }
    return count;
  }

  /// All rays of the group are blocked.
  static void end(Here& here, std::uint32_t group) {
    here.groups.live[group / kRowLanes] &= ~(1u << group % kRowLanes);
  }

  void share(std::uint32_t row, std::uint32_t lanes, bool is_leaf) {
    for (; lanes != 0; lanes &= lanes - 1) {
      LightViewScratch::SharedWork& work = scratch_.shared[first_group_ + row * kRowLanes + first_lane(lanes)];
      ++work.nodes;
      if (is_leaf) ++work.leaves;
    }
  }

  const TriangleBvh& bvh_;
  const LightPoint& light_;
  const ViewErrors& errors_;
  Packets& packets_;
  LightViewScratch& scratch_;
  const GivenUp& is_given_up_;
  std::uint32_t first_group_ = 0;
  std::uint32_t first_waiting_ = 0, waiting_count_ = 0;
  std::size_t room_ = 0;  ///< for meetings of a triangle and a group
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
