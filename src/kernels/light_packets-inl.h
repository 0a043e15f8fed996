// SPDX-License-Identifier: Apache-2.0
// Packets of rays against the triangles that their group may meet, as the light sees both: each triangle takes four
// linear functions of a ray's place in the view. What their bounds leave open goes to the exact test.

#if defined(UMBRIX_KERNELS_LIGHT_PACKETS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_LIGHT_PACKETS_INL_H_
#undef UMBRIX_KERNELS_LIGHT_PACKETS_INL_H_
#else
#define UMBRIX_KERNELS_LIGHT_PACKETS_INL_H_
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>

#include "kernels/group_rays.h"
#include "kernels/light_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

/// Triangles of a group, for (u, v, 1). Values are raised by the bounds of their errors for the group's rays: a ray for
/// which one is negative misses the triangle, and one for which all are above twice the bounds hits it.
struct PacketList {
  static constexpr std::uint32_t kRoom = 256;
  enum Row : std::uint32_t { edge, plane = 9, edge_sure = 12, plane_sure, kRows };

  alignas(64) float rows[kRows][kRoom + kRowLanes];
  alignas(64) std::uint32_t id[kRoom + kRowLanes];
  std::uint32_t count = 0;

  bool is_full() const { return count > kRoom - kRowLanes; }

  void append(const LightTriangles& t, std::uint32_t lanes, const Face& face, const RayGroup& group) {
    const RayTag f;
    const hn::RebindToUnsigned<RayTag> n;
    const auto step = static_cast<std::uint32_t>(hn::Lanes(f));
    const std::uint32_t axes[3] = {face.u_axis(), face.v_axis(), face.axis};
    const auto side = hn::Set(f, face.sign), near = hn::Set(f, group.nearest), far = hn::Set(f, 1 / group.farthest);
    for (std::uint32_t i = 0; i < kRowLanes; i += step) {
      const std::uint32_t some = lanes >> i & ((1u << step) - 1);
      if (some == 0) continue;
      const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(some), static_cast<std::uint8_t>(some >> 8)};
      const auto keep = hn::LoadMaskBits(f, bytes);
      const auto put = [&](std::uint32_t row, RayVec x) { hn::StoreU(hn::Compress(x, keep), f, rows[row] + count); };
      const auto edge_error = hn::MulAdd(hn::Load(f, t.edge_error[1] + i), far, hn::Load(f, t.edge_error[0] + i));
      const auto plane_error = hn::MulAdd(hn::Load(f, t.plane_error[1] + i), near, hn::Load(f, t.plane_error[0] + i));
      for (std::uint32_t e = 0; e < 3; ++e) {
        put(edge + 3 * e, hn::Load(f, t.edge[e][axes[0]] + i));
        put(edge + 3 * e + 1, hn::Load(f, t.edge[e][axes[1]] + i));
        put(edge + 3 * e + 2, hn::MulAdd(hn::Load(f, t.edge[e][axes[2]] + i), side, edge_error));
      }
      put(plane, hn::Load(f, t.plane[axes[0]] + i));
      put(plane + 1, hn::Load(f, t.plane[axes[1]] + i));
      put(plane + 2, hn::MulAdd(hn::Load(f, t.plane[axes[2]] + i), side, plane_error));
      put(edge_sure, hn::Add(edge_error, edge_error));
      put(plane_sure, hn::Add(plane_error, plane_error));
      hn::StoreU(hn::Compress(hn::Load(n, t.id + i), hn::RebindMask(n, keep)), n, id + count);
      count += static_cast<std::uint32_t>(hwy::PopCount(some));
    }
  }
};

class LightPackets {
 public:
  LightPackets(const SceneView& scene, const GroupRays& rays, LightViewScratch& scratch)
      : scene_(scene), rays_(rays), scratch_(scratch), filter_(scene, rays.mask),
        plain_(!rays.skip && filter_.passes_all()) {}

  void trace() {
    sort_meetings();
    std::uint32_t number = 0;
    for (std::uint32_t face = 0; face < kViewFaces; ++face) {
      auto& groups = scratch_.faces[face];
      for (std::uint32_t i = 0; i < groups.groups.size(); ++i, ++number) {
        const RayGroup& group = groups.groups[i];
        if ((groups.live[i / kRowLanes] >> i % kRowLanes & 1) == 0) {
          for (std::uint32_t k = group.first; k < group.first + group.count; ++k) rays_.out[scratch_.name[k]] = 1;
        } else if (scratch_.counts[number] != scratch_.counts[number + 1]) {
          trace_group(Face(face), group, scratch_.counts[number], scratch_.counts[number + 1]);
        }
      }
    }
  }

 private:
  static constexpr std::uint32_t kFewTriangles = 3;

  struct Packet {
    std::uint32_t first, count, blocked;
    float u, v, half_u, half_v, base;
    bool has_bounds;
  };

  void sort_meetings() {
    std::size_t groups = 0;
    for (const auto& face : scratch_.faces) groups += face.groups.size();
    auto& counts = scratch_.counts;
    counts.assign(groups + 2, 0);
    for (const Meeting& m : scratch_.meetings) ++counts[m.group + 2];
    for (std::size_t i = 2; i < counts.size(); ++i) counts[i] += counts[i - 1];
    scratch_.sorted.resize(scratch_.meetings.size());
    for (const Meeting& m : scratch_.meetings) scratch_.sorted[counts[m.group + 1]++] = m;
  }

  void trace_group(const Face& face, const RayGroup& group, std::uint32_t first, std::uint32_t last) {
    make_packets(group);
    sides_.count = edge_on_.count = 0;
    for (std::uint32_t i = first; i < last; ++i) {
      const Meeting& m = scratch_.sorted[i];
      if (i + 4 < last) {
        const char* next = reinterpret_cast<const char*>(&scratch_.triangles[scratch_.sorted[i + 4].triangles]);
        for (std::size_t line = 0; line < sizeof(LightTriangles); line += 64) hwy::Prefetch(next + line);
      }
      const LightTriangles& t = scratch_.triangles[m.triangles];
      if (m.lanes != 0) sides_.append(t, m.lanes, face, group);
      if (m.edge_on != 0) edge_on_.append(t, m.edge_on, face, group);
      if (sides_.is_full() || edge_on_.is_full()) test_all(group);
    }
    test_all(group);
    for (std::uint32_t p = 0; p < packet_count_; ++p)
      for (std::uint32_t rest = packets_[p].blocked; rest != 0; rest &= rest - 1)
        rays_.out[scratch_.name[packets_[p].first + first_lane(rest)]] = 1;
  }

  void make_packets(const RayGroup& group) {
    const auto step = static_cast<std::uint32_t>(hn::Lanes(RayTag()));
    packet_count_ = 0;
    for (std::uint32_t i = 0; i < group.count; i += step) {
      Packet& p = packets_[packet_count_++];
      p.first = group.first + i;
      p.count = std::min(step, group.count - i);
      p.blocked = 0;
      p.has_bounds = false;
    }
  }

  void bound(const RayGroup& group, Packet& p) const {
    const RayTag f;
    const auto infinity = hn::Set(f, std::numeric_limits<float>::infinity());
    const auto su = hn::Set(f, group.slope_u), sv = hn::Set(f, group.slope_v);
    const auto use = hn::FirstN(f, p.count);
    const auto u = hn::LoadU(f, scratch_.u.data() + p.first), v = hn::LoadU(f, scratch_.v.data() + p.first);
    const auto w = hn::LoadU(f, scratch_.w.data() + p.first);
    const auto least = [&](RayVec x) { return hn::GetLane(hn::MinOfLanes(f, hn::IfThenElse(use, x, infinity))); };
    const auto most = [&](RayVec x) {
      return hn::GetLane(hn::MaxOfLanes(f, hn::IfThenElse(use, x, hn::Neg(infinity))));
    };
    const float low_u = least(u), high_u = most(u), low_v = least(v), high_v = most(v);
    p.u = 0.5f * (low_u + high_u);
    p.v = 0.5f * (low_v + high_v);
    p.half_u = std::max(high_u - p.u, p.u - low_u) + 0x1p-20f;
    p.half_v = std::max(high_v - p.v, p.v - low_v) + 0x1p-20f;
    p.base = least(hn::NegMulAdd(sv, v, hn::NegMulAdd(su, u, w))) -
             0x1p-21f * (group.nearest + std::abs(group.slope_u) + std::abs(group.slope_v));
    p.has_bounds = true;
  }

  void test_all(const RayGroup& group) {
    for (std::uint32_t k = 0; k < packet_count_; ++k) {
      Packet& p = packets_[k];
      const std::uint32_t all = static_cast<std::uint32_t>((std::uint64_t{1} << p.count) - 1);
      if (p.blocked == all) continue;
      test(group, p, all);
      if (edge_on_.count != 0 && p.blocked != all) test_edge_on(p, all);
    }
    sides_.count = edge_on_.count = 0;
  }

  struct Pending {
    std::uint32_t lanes, id;
  };

  /// A packet's rays against one triangle of a list.
  struct Lanes {
    RayVec u, v, w;

    HWY_INLINE RayVec linear(const PacketList& list, std::uint32_t row, std::uint32_t i) const {
      const RayTag f;
      return hn::MulAdd(hn::Set(f, list.rows[row][i]), u,
                        hn::MulAdd(hn::Set(f, list.rows[row + 1][i]), v, hn::Set(f, list.rows[row + 2][i])));
    }
    HWY_INLINE void test(const PacketList& list, std::uint32_t i, RayMask& hit, RayMask& open) const {
      const RayTag f;
      const auto inner = hn::Min(linear(list, PacketList::edge, i),
                                 hn::Min(linear(list, PacketList::edge + 3, i), linear(list, PacketList::edge + 6, i)));
      const auto before = hn::Sub(linear(list, PacketList::plane, i), w);
      open = hn::Ge(hn::Min(inner, before), hn::Zero(f));
      hit = hn::And(hn::Gt(inner, hn::Set(f, list.rows[PacketList::edge_sure][i])),
                    hn::Gt(before, hn::Set(f, list.rows[PacketList::plane_sure][i])));
    }
  };

  Lanes load(const Packet& p) const {
    const RayTag f;
    return {hn::LoadU(f, scratch_.u.data() + p.first), hn::LoadU(f, scratch_.v.data() + p.first),
            hn::LoadU(f, scratch_.w.data() + p.first)};
  }

  void test(const RayGroup& group, Packet& p, std::uint32_t all) {
    const RayTag f;
    const Lanes rays = load(p);
    const auto bits_to_mask = [&](std::uint32_t bits) {
      const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8)};
      return hn::LoadMaskBits(f, bytes);
    };
    auto blocked = bits_to_mask(p.blocked | ~all);
    if (sides_.count > kFewTriangles && !p.has_bounds) bound(group, p);
    for (std::uint32_t begin = 0; begin < sides_.count; begin += kRowLanes) {
      std::uint32_t met = (1u << std::min(kRowLanes, sides_.count - begin)) - 1;
      if (sides_.count > kFewTriangles) met &= cull(group, p, begin);
      if (met == 0) continue;
      if (!plain_) {
        test_each(p, rays, begin, met, all);
        if (p.blocked == all) return;
        continue;
      }
      auto unsure = hn::MaskFromVec(hn::Zero(f));
      for (std::uint32_t rest = met; rest != 0; rest &= rest - 1) {
        RayMask hit, open;
        rays.test(sides_, begin + first_lane(rest), hit, open);
        blocked = hn::Or(blocked, hit);
        unsure = hn::Or(unsure, hn::AndNot(hit, open));
        if (hn::AllTrue(f, blocked)) {
          p.blocked = all;
          return;
        }
      }
      p.blocked = ray_bits(blocked) & all;
      if (HWY_UNLIKELY((ray_bits(unsure) & all & ~p.blocked) != 0)) {
        test_each(p, rays, begin, met, all);
        blocked = bits_to_mask(p.blocked | ~all);
      }
    }
  }

  /// Where hits need a second look: what is open is decided exactly, and skipped or see-through triangles are left out.
  HWY_NOINLINE void test_each(Packet& p, const Lanes& rays, std::uint32_t begin, std::uint32_t met, std::uint32_t all) {
    pendings_ = 0;
    for (; met != 0; met &= met - 1) {
      const std::uint32_t i = begin + first_lane(met);
      RayMask hit, open;
      rays.test(sides_, i, hit, open);
      const std::uint32_t hits = ray_bits(hit) & all, unsure = ray_bits(open) & all & ~hits & ~p.blocked;
      if (unsure != 0) add_pending(p, unsure, sides_.id[i]);
      p.blocked |= plain_ ? hits : admitted(p, hits & ~p.blocked, sides_.id[i]);
    }
    decide(p);
  }

  std::uint32_t cull(const RayGroup& group, const Packet& p, std::uint32_t begin) const {
    const RayTag f;
    std::uint32_t met = 0;
    const auto u = hn::Set(f, p.u), v = hn::Set(f, p.v), half_u = hn::Set(f, p.half_u), half_v = hn::Set(f, p.half_v);
    for (std::uint32_t i = 0; i < kRowLanes; i += static_cast<std::uint32_t>(hn::Lanes(f))) {
      const auto row = [&](std::uint32_t r) { return hn::LoadU(f, sides_.rows[r] + begin + i); };
      const auto most = [&](RayVec a, RayVec b, RayVec c) {
        return hn::MulAdd(a, u, hn::MulAdd(b, v, hn::MulAdd(hn::Abs(a), half_u, hn::MulAdd(hn::Abs(b), half_v, c))));
      };
      auto inner = most(row(PacketList::edge), row(PacketList::edge + 1), row(PacketList::edge + 2));
      inner = hn::Min(inner, most(row(PacketList::edge + 3), row(PacketList::edge + 4), row(PacketList::edge + 5)));
      inner = hn::Min(inner, most(row(PacketList::edge + 6), row(PacketList::edge + 7), row(PacketList::edge + 8)));
      const auto before = most(hn::Sub(row(PacketList::plane), hn::Set(f, group.slope_u)),
                               hn::Sub(row(PacketList::plane + 1), hn::Set(f, group.slope_v)),
                               hn::Sub(row(PacketList::plane + 2), hn::Set(f, p.base)));
      const auto open = hn::Ge(hn::Min(inner, before), hn::Zero(f));
      met |= ray_bits(open) << i;
    }
    return met;
  }

  /// The light is in the triangle's plane or nearly so: a ray that passes two edges on different sides misses it.
  void test_edge_on(Packet& p, std::uint32_t all) {
    const RayTag f;
    const Lanes rays = load(p);
    pendings_ = 0;
    for (std::uint32_t i = 0; i < edge_on_.count; ++i) {
      const auto a = rays.linear(edge_on_, PacketList::edge, i), b = rays.linear(edge_on_, PacketList::edge + 3, i);
      const auto c = rays.linear(edge_on_, PacketList::edge + 6, i);
      const auto sure = hn::Set(f, edge_on_.rows[PacketList::edge_sure][i]);
      const auto apart = hn::And(hn::Gt(hn::Max(a, hn::Max(b, c)), sure), hn::Lt(hn::Min(a, hn::Min(b, c)), hn::Zero(f)));
      const std::uint32_t open = all & ~p.blocked & ~ray_bits(apart);
      if (open != 0) add_pending(p, open, edge_on_.id[i]);
    }
    decide(p);
  }

  void add_pending(Packet& p, std::uint32_t lanes, std::uint32_t id) {
    if (pendings_ == kMostPending) decide(p);
    pending_[pendings_++] = {lanes, id};
  }

  /// Exactly, ray by ray.
  HWY_NOINLINE void decide(Packet& p) {
    NoCounts none;
    for (std::uint32_t k = 0; k < pendings_; ++k) {
      for (std::uint32_t rest = pending_[k].lanes & ~p.blocked; rest != 0; rest &= rest - 1) {
        const std::uint32_t i = scratch_.name[p.first + first_lane(rest)];
        if (rays_.skip) filter_.set_skip(rays_.skip[i]);
        ++exact_;
        if (blocks(scene_, filter_, rays_.rays[i], pending_[k].id, none)) p.blocked |= rest & (0u - rest);
      }
    }
    pendings_ = 0;
  }

  std::uint32_t admitted(const Packet& p, std::uint32_t lanes, std::uint32_t id) {
    std::uint32_t result = 0;
    for (; lanes != 0; lanes &= lanes - 1) {
      const std::uint32_t i = scratch_.name[p.first + first_lane(lanes)];
      if (rays_.skip) filter_.set_skip(rays_.skip[i]);
      if (filter_.admits(id) && filter_.is_opaque(rays_.rays[i], id)) result |= lanes & (0u - lanes);
    }
    return result;
  }

  static constexpr std::uint32_t kMostPending = 64;

  const SceneView& scene_;
  const GroupRays& rays_;
  LightViewScratch& scratch_;
  Filter filter_;
  bool plain_;
  PacketList sides_, edge_on_;
  Packet packets_[kMostRays];
  std::uint32_t packet_count_ = 0;
  Pending pending_[kMostPending];
  std::uint32_t pendings_ = 0;

 public:
  std::uint64_t exact_ = 0;
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
