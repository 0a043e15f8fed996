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

/// A packet's rays, and what is found of them.
struct PacketLanes {
  RayVec u, v, w;
  RayMask blocked;

  HWY_INLINE PacketLanes(const LightViewScratch& rays, const LightPacket& p) : blocked(lane_mask(p.blocked)) {
    const RayTag f;
    u = hn::LoadU(f, rays.u.data() + p.first);
    v = hn::LoadU(f, rays.v.data() + p.first);
    w = hn::LoadU(f, rays.w.data() + p.first);
  }
};

/// Bounds of the values of triangles for all rays of a group.
struct GroupErrors {
  alignas(64) float edge[kRowLanes], plane[kRowLanes];

  HWY_INLINE GroupErrors(const LightTriangles& t, const RayGroup& group) {
    const RayTag f;
    for (std::uint32_t i = 0; i < kRowLanes; i += static_cast<std::uint32_t>(hn::Lanes(f))) {
      hn::Store(error_bound(t.edge_error, i, group.reach), f, edge + i);
      hn::Store(error_bound(t.plane_error, i, group.nearest), f, plane + i);
    }
  }
};

/// How sure hits are: the signs of a difference and of a sum are those of real numbers.
struct HitMargins {
  RayVec sure, open;

  RayMask hit() const { return hn::Gt(sure, hn::Zero(RayTag())); }
  RayMask may_hit() const { return hn::Ge(open, hn::Zero(RayTag())); }  ///< those that hit too
};

/// One triangle, in all lanes.
class TriangleTest {
 public:
  HWY_INLINE TriangleTest(const LightTriangles& t, std::uint32_t lane, const GroupErrors& errors) {
    const RayTag f;
    for (std::uint32_t k = 0; k < 3; ++k) {
      for (std::uint32_t e = 0; e < 3; ++e) edge_[e][k] = hn::Set(f, t.edge[e][k][lane]);
      plane_[k] = hn::Set(f, t.plane[k][lane]);
    }
    edge_error_ = hn::Set(f, errors.edge[lane]);
    plane_error_ = hn::Set(f, errors.plane[lane]);
  }

  HWY_INLINE HitMargins operator()(const PacketLanes& p) const {
    const auto inner = hn::Min(edge(0, p), hn::Min(edge(1, p), edge(2, p)));
    const auto before = hn::Sub(linear(plane_, p), p.w);
    return {hn::Min(hn::Sub(inner, edge_error_), hn::Sub(before, plane_error_)),
            hn::Min(hn::Add(inner, edge_error_), hn::Add(before, plane_error_))};
  }

  /// For a plane that the light is too near to: lanes that may hit, as they pass no two edges on different sides.
  RayMask edge_on(const PacketLanes& p) const {
    const auto a = edge(0, p), b = edge(1, p), c = edge(2, p);
    const auto apart = hn::And(hn::Gt(hn::Max(a, hn::Max(b, c)), edge_error_),
                               hn::Lt(hn::Min(a, hn::Min(b, c)), hn::Neg(edge_error_)));
    return hn::Not(apart);
  }

 private:
  static HWY_INLINE RayVec linear(const RayVec (&c)[3], const PacketLanes& p) {
    return hn::MulAdd(c[0], p.u, hn::MulAdd(c[1], p.v, c[2]));
  }
  HWY_INLINE RayVec edge(std::uint32_t k, const PacketLanes& p) const { return linear(edge_[k], p); }

  RayVec edge_[3][3], plane_[3];
  RayVec edge_error_, plane_error_;
};

/// Answers the rays of all groups from what the walk finds that they may meet.
template <class Counts>
class LightPackets {
 public:
  static constexpr bool kCounts = !std::is_same_v<Counts, NoCounts>;

  /// `each` takes the work of each ray, if it is counted.
  LightPackets(const SceneView& scene, const GroupRays& rays, const ViewErrors& errors, LightViewScratch& scratch,
               std::vector<Counts>& each)
      : scene_(scene),
        margin_(0x1p-20f + 2 * errors.start),
        rays_(rays),
        scratch_(scratch),
        each_(each),
        filter_(scene, rays.mask),
        plain_(!rays.skip && filter_.passes_all()) {
    scratch_.packets.clear();
    scratch_.open.clear();
  }

  /// No triangle is skipped or seen through.
  bool is_plain() const { return plain_; }

  /// All of the group's rays are blocked.
  void cover(const RayGroup& group) {
    for_packets(group, [](LightPacket& p, std::uint32_t) { p.blocked = all_lanes(); });
  }

  /// For those that may meet something soon.
  HWY_INLINE void prefetch(const RayGroup& group) const {
    for (std::uint32_t k = group.first; k < group.first + group.count; k += kRowLanes) {
      hwy::Prefetch(scratch_.u.data() + k);
      hwy::Prefetch(scratch_.v.data() + k);
      hwy::Prefetch(scratch_.w.data() + k);
    }
  }

  /// Adds the group's packets that triangles come near to the `count` that the scratch has.
  HWY_INLINE void choose(RayGroup& group, const MetGroup& met, const LightTriangles& triangles, std::size_t& count) {
    if (group.packets == RayGroup::kNone) load(group);
    auto& chosen = scratch_.met_packets;
    if (chosen.size() < count + kGroupRays) chosen.resize(2 * (count + kGroupRays));
    MetPacket* out = chosen.data() + count;
    const bool is_one = (met.triangles & (met.triangles - 1)) == 0;  // it costs as much to test its box
    for_packets(group, [&](const LightPacket& p, std::uint32_t number) {
      const std::uint32_t wanted =
          is_one ? met.triangles : met.triangles & meeting<Starts::in_box>(triangles.bounds, p.box);
      *out = {met.group, number, wanted};
      out += wanted != 0 && p.blocked != all_lanes() ? 1 : 0;
    });
    count = static_cast<std::size_t>(out - chosen.data());
  }

  /// Triangles that may block some ray of the packet. True if none of its group's rays is left.
  HWY_INLINE bool meet(RayGroup& group, const LightTriangles& triangles, const MetPacket& met) {
    LightPacket& p = scratch_.packets[met.packet];
    if (plain_ && (met.triangles & triangles.edge_on) == 0)
      test(group, triangles, met.triangles, p, met.packet);
    else
      decide(group, triangles, met.triangles, p);
    if (p.blocked != all_lanes()) return false;
    return --group.open == 0;
  }

  /// Writes all answers.
  void finish() {
    for (const OpenRays& open : scratch_.open) {
      LightPacket& p = scratch_.packets[open.packet];
      p.blocked |= exactly(p, open.lanes & ~p.blocked, open.id);
    }
    std::uint32_t number = 0;
    for (const auto& face : scratch_.faces) {
      for (std::uint32_t i = 0; i < face.groups.size(); ++i, ++number) {
        const RayGroup& group = face.groups[i];
        if constexpr (kCounts) share(group, scratch_.shared[number]);
        if ((face.live[i / kRowLanes] >> i % kRowLanes & 1) == 0) {
          for (std::uint32_t k = group.first; k < group.first + group.count; ++k) rays_.out[name(k)] = 1;
        } else {
          deliver(group);
        }
      }
    }
  }

 private:
  static std::uint32_t all_lanes() { return static_cast<std::uint32_t>((std::uint64_t{1} << hn::Lanes(RayTag())) - 1); }

  template <class Each>
  HWY_INLINE void for_packets(const RayGroup& group, Each&& each) {
    if (group.packets == RayGroup::kNone) return;
    const auto lanes = static_cast<std::uint32_t>(hn::Lanes(RayTag()));
    const std::uint32_t last = group.packets + (group.count + lanes - 1) / lanes;
    for (std::uint32_t k = group.packets; k < last; ++k) each(scratch_.packets[k], k);
  }

  void load(RayGroup& group) {
    group.packets = static_cast<std::uint32_t>(scratch_.packets.size());
    group.open = 0;
    for_lanes(group.first, group.count, [&](std::size_t i, RayMask use) {
      LightPacket p;
      p.first = static_cast<std::uint32_t>(i);
      p.blocked = all_lanes() & ~ray_bits(use);
      bound(p);
      scratch_.packets.push_back(p);
      ++group.open;
    });
  }

  void bound(LightPacket& p) const {
    const RayTag f;
    const PacketLanes x(scratch_, p);
    const auto infinity = hn::Set(f, std::numeric_limits<float>::infinity());
    const auto present = [&](RayVec value) { return hn::IfThenElse(x.blocked, infinity, value); };
    const FourLeast least(present(x.u), present(hn::Neg(x.u)), present(x.v), present(hn::Neg(x.v)));
    const float farthest = hn::GetLane(hn::MinOfLanes(f, present(x.w)));
    p.box = {least.of[0] - margin_, margin_ - least.of[1], least.of[2] - margin_, margin_ - least.of[3],
             farthest * (1 - 4 * margin_)};
  }

  HWY_INLINE void test(const RayGroup& group, const LightTriangles& triangles, std::uint32_t wanted, LightPacket& p,
                       std::uint32_t number) {
    const RayTag f;
    const GroupErrors errors(triangles, group);
    PacketLanes x(scratch_, p);
    HitMargins most{hn::Set(f, -1.0f), hn::Set(f, -1.0f)};  // of all triangles: masks for each cost more
    for (std::uint32_t rest = wanted; rest != 0; rest &= rest - 1) {
      if constexpr (kCounts) count_tests(p, hn::Or(x.blocked, most.hit()));
      const HitMargins here = TriangleTest(triangles, first_lane(rest), errors)(x);
      most = {hn::Max(most.sure, here.sure), hn::Max(most.open, here.open)};
    }
    x.blocked = hn::Or(x.blocked, most.hit());
    p.blocked = ray_bits(x.blocked);
    if (HWY_UNLIKELY(!hn::AllFalse(f, hn::AndNot(x.blocked, most.may_hit()))))
      note_open(errors, triangles, wanted, p, number, x);
  }

  /// For the end, as most are blocked by something else; where they are very many, at once.
  HWY_NOINLINE void note_open(const GroupErrors& errors, const LightTriangles& triangles, std::uint32_t wanted,
                              LightPacket& p, std::uint32_t number, const PacketLanes& x) {
    for (; wanted != 0; wanted &= wanted - 1) {
      const std::uint32_t lane = first_lane(wanted);
      const std::uint32_t rays = ray_bits(TriangleTest(triangles, lane, errors)(x).may_hit()) & ~p.blocked;
      if (rays == 0) continue;
      if (scratch_.open.size() < scratch_.ray_count)
        scratch_.open.push_back({number, rays, triangles.id[lane]});
      else
        p.blocked |= exactly(p, rays, triangles.id[lane]);
    }
  }

  /// Ray by ray where that is needed: what is open is decided exactly, and what is skipped or seen through left out.
  HWY_NOINLINE void decide(const RayGroup& group, const LightTriangles& triangles, std::uint32_t wanted,
                           LightPacket& p) {
    const GroupErrors errors(triangles, group);
    PacketLanes x(scratch_, p);
    for (std::uint32_t rest = wanted; rest != 0; rest &= rest - 1) {
      if constexpr (kCounts) count_tests(p, x.blocked);
      const std::uint32_t lane = first_lane(rest), id = triangles.id[lane];
      const TriangleTest test(triangles, lane, errors);
      const bool edge_on = (triangles.edge_on >> lane & 1) != 0;
      const HitMargins margins = test(x);
      const std::uint32_t hits = edge_on ? 0 : ray_bits(margins.hit()) & ~p.blocked;
      const std::uint32_t open = ray_bits(edge_on ? test.edge_on(x) : margins.may_hit()) & ~p.blocked & ~hits;
      const std::uint32_t sure = plain_ ? hits : admitted(p, hits, id);
      p.blocked |= sure | exactly(p, open, id);
      x.blocked = lane_mask(p.blocked);
    }
  }

  void deliver(const RayGroup& group) {
    for_packets(group, [&](const LightPacket& p, std::uint32_t) {
      const std::uint32_t count = group.first + group.count - p.first;
      std::uint32_t rest = p.blocked;
      if (count < kRowLanes) rest &= (1u << count) - 1;
      for (; rest != 0; rest &= rest - 1) rays_.out[name(p.first + first_lane(rest))] = 1;
    });
  }

  /// Equal parts of the walk, the first rays taking the rest.
  void share(const RayGroup& group, const LightViewScratch::SharedWork& work) {
    for (std::uint32_t k = 0; k < group.count; ++k) {
      RayCounts& counts = each_[name(group.first + k)].counts;
      counts.node_tests += work.nodes / group.count + (k < work.nodes % group.count ? 1 : 0);
      counts.leaf_visits += work.leaves / group.count + (k < work.leaves % group.count ? 1 : 0);
    }
  }

  void count_tests(const LightPacket& p, RayMask blocked) {
    for (std::uint32_t rest = all_lanes() & ~ray_bits(blocked); rest != 0; rest &= rest - 1)
      each_[name(p.first + first_lane(rest))].primitives(1);
  }

  std::size_t name(std::size_t place) const { return static_cast<std::size_t>(scratch_.name[place]); }

  std::uint32_t exactly(const LightPacket& p, std::uint32_t lanes, std::uint32_t id) {
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

  std::uint32_t admitted(const LightPacket& p, std::uint32_t lanes, std::uint32_t id) {
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
