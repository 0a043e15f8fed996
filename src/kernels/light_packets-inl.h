// SPDX-License-Identifier: Apache-2.0
// Groups of rays against the triangles that they may meet, as the light sees both: each triangle takes four linear
// functions of a ray's place in the view. What their bounds leave open goes to the exact test.

#if defined(UMBRIX_KERNELS_LIGHT_PACKETS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_LIGHT_PACKETS_INL_H_
#undef UMBRIX_KERNELS_LIGHT_PACKETS_INL_H_
#else
#define UMBRIX_KERNELS_LIGHT_PACKETS_INL_H_
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <limits>
#include <type_traits>
#include <vector>

#include "kernels/group_rays.h"
#include "kernels/light_triangles-inl.h"
#include "kernels/light_view.h"
#include "kernels/ray_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

/// Some rays of a group side by side.
struct Packet {
  RayVec u, v, w;
  RayMask blocked, unsure;
  std::uint32_t first, count;
  ViewBox box;
};

/// One triangle, in all lanes.
class TriangleTest {
 public:
  HWY_INLINE TriangleTest(const LightTriangles& t, std::uint32_t lane, const RayGroup& group) {
    const RayTag f;
    for (std::uint32_t k = 0; k < 3; ++k) {
      for (std::uint32_t e = 0; e < 3; ++e) edge_[e][k] = hn::Set(f, t.edge[e][k][lane]);
      plane_[k] = hn::Set(f, t.plane[k][lane]);
    }
    edge_error_ = hn::Set(f, t.edge_error[0][lane] + t.edge_error[1][lane] * group.reach);
    plane_error_ = hn::Set(f, t.plane_error[0][lane] + t.plane_error[1][lane] * group.nearest);
  }

  /// Lanes that surely hit, and those that may.
  HWY_INLINE void operator()(const Packet& p, RayMask& hit, RayMask& open) const {
    const auto inner = hn::Min(edge(0, p), hn::Min(edge(1, p), edge(2, p)));
    const auto before = hn::Sub(linear(plane_, p), p.w);
    hit = hn::And(hn::Gt(inner, edge_error_), hn::Gt(before, plane_error_));
    open = hn::And(hn::Ge(inner, hn::Neg(edge_error_)), hn::Ge(before, hn::Neg(plane_error_)));
  }

  /// For a plane that the light is too near to: lanes that may hit, as they pass no two edges on different sides.
  RayMask edge_on(const Packet& p) const {
    const auto a = edge(0, p), b = edge(1, p), c = edge(2, p);
    const auto apart = hn::And(hn::Gt(hn::Max(a, hn::Max(b, c)), edge_error_),
                               hn::Lt(hn::Min(a, hn::Min(b, c)), hn::Neg(edge_error_)));
    return hn::Not(apart);
  }

 private:
  static HWY_INLINE RayVec linear(const RayVec (&c)[3], const Packet& p) {
    return hn::MulAdd(c[0], p.u, hn::MulAdd(c[1], p.v, c[2]));
  }
  HWY_INLINE RayVec edge(std::uint32_t k, const Packet& p) const { return linear(edge_[k], p); }

  RayVec edge_[3][3], plane_[3];
  RayVec edge_error_, plane_error_;
};

/// Answers the rays of all groups from what they may meet.
template <class Counts>
class LightPackets {
 public:
  /// `each` takes the work of each ray, if it is counted.
  LightPackets(const SceneView& scene, const GroupRays& rays, const ViewErrors& errors, LightViewScratch& scratch,
               std::vector<Counts>& each)
      : scene_(scene),
        margin_(0x1p-20f + 2 * errors.start),
        rays_(rays),
        scratch_(scratch),
        each_(each),
        filter_(scene, rays.mask),
        plain_(!rays.skip && filter_.passes_all()) {}

  void trace() {
    sort_meetings();
    std::uint32_t number = 0;
    for (std::uint32_t face = 0; face < kViewFaces; ++face) {
      auto& groups = scratch_.faces[face];
      for (std::uint32_t i = 0; i < groups.groups.size(); ++i, ++number) {
        const RayGroup& group = groups.groups[i];
        if constexpr (kCounts) share(group, scratch_.shared[number]);
        if ((groups.live[i / kRowLanes] >> i % kRowLanes & 1) == 0) {
          for (std::uint32_t k = group.first; k < group.first + group.count; ++k) rays_.out[name(k)] = 1;
        } else if (scratch_.counts[number] != scratch_.counts[number + 1]) {
          trace_group(group, scratch_.counts[number], scratch_.counts[number + 1]);
        }
      }
    }
  }

 private:
  static constexpr bool kCounts = !std::is_same_v<Counts, NoCounts>;
#if HWY_TARGET == HWY_SCALAR
  static constexpr std::uint32_t kMostPackets = kGroupRays;
#else
  static constexpr std::uint32_t kMostPackets = kGroupRays / 4;
#endif

  void sort_meetings() {
    auto& counts = scratch_.counts;
    counts.assign(scratch_.group_count() + 2, 0);
    for (const Meeting& m : scratch_.meetings) ++counts[m.group + 2];
    for (std::size_t i = 2; i < counts.size(); ++i) counts[i] += counts[i - 1];
    scratch_.sorted.resize(scratch_.meetings.size());
    for (const Meeting& m : scratch_.meetings) scratch_.sorted[counts[m.group + 1]++] = m;
  }

  void trace_group(const RayGroup& group, std::uint32_t first, std::uint32_t last) {
    Packet packets[kMostPackets];
    const std::uint32_t count = load(group, packets);
    for (std::uint32_t i = first; i < last; ++i) {
      const Meeting& m = scratch_.sorted[i];
      const LightTriangles& triangles = scratch_.triangles[m.triangles];
      if (i + 1 < last) prefetch(scratch_.triangles[scratch_.sorted[i + 1].triangles]);
      if (!plain_ || m.edge_on != 0) {
        for (std::uint32_t k = 0; k < count; ++k) decide(group, m, packets[k]);
        continue;
      }
      std::uint32_t left = 0;
      for (std::uint32_t k = 0; k < count; ++k) {
        if (hn::AllTrue(RayTag(), packets[k].blocked)) continue;
        ++left;
        test(triangles, m.lanes & meeting<Starts::in_box>(triangles.bounds, packets[k].box), group, packets[k]);
      }
      if (left == 0) break;
    }
    bool is_open = false;
    for (std::uint32_t k = 0; k < count; ++k) is_open = is_open || is_unsure(packets[k]);
    if (HWY_UNLIKELY(is_open)) {
      for (std::uint32_t k = 0; k < count; ++k)
        for (std::uint32_t i = first; i < last && is_unsure(packets[k]); ++i)
          if (scratch_.sorted[i].edge_on == 0) decide(group, scratch_.sorted[i], packets[k]);
    }
    for (std::uint32_t k = 0; k < count; ++k) {
      for (std::uint32_t rest = ray_bits(packets[k].blocked) & present(packets[k]); rest != 0; rest &= rest - 1)
        rays_.out[name(packets[k].first + first_lane(rest))] = 1;
    }
  }

  /// Lanes without a ray are blocked from the start.
  std::uint32_t load(const RayGroup& group, Packet* packets) const {
    const RayTag f;
    const auto step = static_cast<std::uint32_t>(hn::Lanes(f));
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < group.count; i += step) {
      Packet& p = packets[count++];
      p.first = group.first + i;
      p.count = std::min(step, group.count - i);
      p.u = hn::LoadU(f, scratch_.u.data() + p.first);
      p.v = hn::LoadU(f, scratch_.v.data() + p.first);
      p.w = hn::LoadU(f, scratch_.w.data() + p.first);
      p.blocked = hn::Not(hn::FirstN(f, p.count));
      p.unsure = hn::MaskFromVec(hn::Zero(f));
      bound(p);
    }
    return count;
  }

  HWY_INLINE void test(const LightTriangles& triangles, std::uint32_t lanes, const RayGroup& group, Packet& p) {
    for (; lanes != 0; lanes &= lanes - 1) {
      if constexpr (kCounts) count_tests(p);
      RayMask hit, open;
      TriangleTest(triangles, first_lane(lanes), group)(p, hit, open);
      p.blocked = hn::Or(p.blocked, hit);
      p.unsure = hn::Or(p.unsure, hn::AndNot(hit, open));
    }
  }

  void bound(Packet& p) const {
    const RayTag f;
    const auto use = hn::FirstN(f, p.count);
    const auto infinity = hn::Set(f, std::numeric_limits<float>::infinity());
    const auto least = [&](RayVec x) { return hn::GetLane(hn::MinOfLanes(f, hn::IfThenElse(use, x, infinity))); };
    const auto most = [&](RayVec x) {
      return hn::GetLane(hn::MaxOfLanes(f, hn::IfThenElse(use, x, hn::Neg(infinity))));
    };
    p.box = {least(p.u) - margin_, most(p.u) + margin_, least(p.v) - margin_, most(p.v) + margin_,
             least(p.w) * (1 - 4 * margin_)};
  }

  static void prefetch(const LightTriangles& t) {
    for (std::size_t line = 0; line < sizeof t; line += 64) hwy::Prefetch(reinterpret_cast<const char*>(&t) + line);
  }

  /// Equal parts of the walk, the first rays taking the rest.
  void share(const RayGroup& group, const LightViewScratch::SharedWork& work) {
    for (std::uint32_t k = 0; k < group.count; ++k) {
      RayCounts& counts = each_[name(group.first + k)].counts;
      counts.node_tests += work.nodes / group.count + (k < work.nodes % group.count ? 1 : 0);
      counts.leaf_visits += work.leaves / group.count + (k < work.leaves % group.count ? 1 : 0);
    }
  }

  void count_tests(const Packet& p) {
    for (std::uint32_t rest = ~ray_bits(p.blocked) & present(p); rest != 0; rest &= rest - 1)
      each_[name(p.first + first_lane(rest))].primitives(1);
  }

  static std::uint32_t present(const Packet& p) {
    return static_cast<std::uint32_t>((std::uint64_t{1} << p.count) - 1);
  }
  std::size_t name(std::size_t place) const { return static_cast<std::size_t>(scratch_.name[place]); }

  /// Ray by ray where that is needed: what is open is decided exactly, and what is skipped or seen through left out.
  HWY_NOINLINE void decide(const RayGroup& group, const Meeting& m, Packet& p) {
    const LightTriangles& triangles = scratch_.triangles[m.triangles];
    const std::uint32_t lanes = m.lanes | m.edge_on;
    for (std::uint32_t rest = lanes & meeting<Starts::in_box>(triangles.bounds, p.box); rest != 0; rest &= rest - 1) {
      if constexpr (kCounts) {
        if (!plain_ || m.edge_on != 0) count_tests(p);  // others were counted before
      }
      const std::uint32_t lane = first_lane(rest);
      const TriangleTest test(triangles, lane, group);
      RayMask hit = hn::MaskFromVec(hn::Zero(RayTag())), open;
      if ((m.edge_on >> lane & 1) != 0)
        open = test.edge_on(p);
      else
        test(p, hit, open);
      const std::uint32_t left = ~ray_bits(p.blocked), hits = ray_bits(hit) & left;
      std::uint32_t blocked = plain_ ? hits : admitted(p, hits, triangles.id[lane]);
      blocked |= exactly(p, ray_bits(open) & left & ~hits, triangles.id[lane]);
      p.blocked = hn::Or(p.blocked, lane_mask(blocked));
    }
  }

  static bool is_unsure(const Packet& p) { return !hn::AllFalse(RayTag(), hn::AndNot(p.blocked, p.unsure)); }

  std::uint32_t exactly(const Packet& p, std::uint32_t lanes, std::uint32_t id) {
    NoCounts none;
    std::uint32_t result = 0;
    for (; lanes != 0; lanes &= lanes - 1) {
      const std::size_t i = name(p.first + first_lane(lanes));
      if (rays_.skip) filter_.set_skip(rays_.skip[i]);
      bool is_blocked;
      if constexpr (kCounts)
        is_blocked = blocks(scene_, filter_, rays_.rays[i], id, each_[i]);
      else
        is_blocked = blocks(scene_, filter_, rays_.rays[i], id, none);
      if (is_blocked) result |= lanes & (0u - lanes);
    }
    return result;
  }

  std::uint32_t admitted(const Packet& p, std::uint32_t lanes, std::uint32_t id) {
    std::uint32_t result = 0;
    for (; lanes != 0; lanes &= lanes - 1) {
      const std::size_t i = name(p.first + first_lane(lanes));
      if (rays_.skip) filter_.set_skip(rays_.skip[i]);
      if (filter_.admits(id) && filter_.is_opaque(rays_.rays[i], id)) result |= lanes & (0u - lanes);
    }
    return result;
  }

  const SceneView& scene_;
  float margin_;  ///< of packets' boxes
  const GroupRays& rays_;
  LightViewScratch& scratch_;
  std::vector<Counts>& each_;
  Filter filter_;
  bool plain_;
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
