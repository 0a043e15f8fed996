// SPDX-License-Identifier: Apache-2.0
// Nearest hits of rays from one point, as from a camera, in packets: one walk for sixteen rays, then for each triangle
// that some may hit a product of three terms a ray. With s = o - v0 and the test of leaf_test-inl.h,
//   det = d . (e2 x e1),   U = d . (e2 x s),   V = d . (s x e1),   T = e2 . (s x e1):
// the same sums of the same products, each of as many roundings, so its bounds hold as they are. Over the box of all
// directions they are middle and half instead, two roundings more: there a value counts as decided from 2 E on.

#if defined(UMBRIX_KERNELS_CLOSEST_TRACE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_CLOSEST_TRACE_INL_H_
#undef UMBRIX_KERNELS_CLOSEST_TRACE_INL_H_
#else
#define UMBRIX_KERNELS_CLOSEST_TRACE_INL_H_
#endif

#include <hwy/highway.h>

#include <limits>

#include "core/float_mode.h"
#include "kernels/closest_packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

/// A row of triangles as a packet's origin sees them.
struct alignas(64) PacketTriangles {
  float det[3][kRowLanes], u[3][kRowLanes], v[3][kRowLanes];  ///< to be multiplied by a direction
  float time[kRowLanes];                                      ///< T
  float error[kRowLanes], time_error[kRowLanes];              ///< of det, U, V and W; of T
  float square;                                               ///< by t, a bound of the error of t det
};

/// Which of a row's triangles a packet may hit before `last_time`; of these `out` is filled.
HWY_INLINE std::uint32_t look_at_row(const ClosestPacket& packet, const TriangleRows& rows, float last_time,
                                     PacketTriangles& out) {
  const RayTag f;
  const auto zero = hn::Zero(f);
  const float edge = rows.edge_bound;
  out.square = kNormBound * edge * edge * packet.length;
  std::uint32_t result = 0;
  for (std::uint32_t i = 0; i < kRowLanes; i += static_cast<std::uint32_t>(hn::Lanes(f))) {
    RayVec s[3], e1[3], e2[3], det[3], u[3], v[3];
    auto distance = zero;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const auto v0 = hn::Load(f, rows.v[0][k] + i);
      s[k] = hn::Sub(hn::Set(f, packet.origin[k]), v0);
      e1[k] = hn::Sub(hn::Load(f, rows.v[1][k] + i), v0);
      e2[k] = hn::Sub(hn::Load(f, rows.v[2][k] + i), v0);
      distance = hn::Add(distance, hn::Abs(s[k]));
    }
    // A little more for the rounding of the sum itself.
    distance = hn::Mul(distance, hn::Set(f, 1 + 0x1p-20f));
    const auto cross = [](const RayVec(&a)[3], const RayVec(&b)[3], RayVec(&c)[3]) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t k1 = (k + 1) % 3, k2 = (k + 2) % 3;
        c[k] = hn::MulSub(a[k1], b[k2], hn::Mul(a[k2], b[k1]));
      }
    };
    cross(e2, e1, det);
    cross(e2, s, u);
    cross(s, e1, v);
    auto det_middle = zero, u_middle = zero, v_middle = zero, det_off = zero, u_off = zero, v_off = zero, w_off = zero;
    auto time = zero;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const auto middle = hn::Set(f, packet.middle[k]), half = hn::Set(f, packet.half[k]);
      det_middle = hn::MulAdd(det[k], middle, det_middle);
      u_middle = hn::MulAdd(u[k], middle, u_middle);
      v_middle = hn::MulAdd(v[k], middle, v_middle);
      det_off = hn::MulAdd(hn::Abs(det[k]), half, det_off);
      u_off = hn::MulAdd(hn::Abs(u[k]), half, u_off);
      v_off = hn::MulAdd(hn::Abs(v[k]), half, v_off);
      w_off = hn::MulAdd(hn::Abs(hn::Sub(hn::Sub(det[k], u[k]), v[k])), half, w_off);
      time = hn::MulAdd(e2[k], v[k], time);
    }
    const auto error = hn::MulAdd(hn::Set(f, kNormBound * packet.length * edge),
                                  hn::Add(hn::Add(distance, distance), hn::Set(f, edge)), hn::Set(f, kTinyEdge));
    const auto time_error = hn::MulAdd(hn::Set(f, kNormBound * edge * edge), distance, hn::Set(f, kTinyTime));
    const auto twice = hn::Add(error, error);

    const auto known = hn::Gt(hn::Sub(hn::Abs(det_middle), det_off), twice);
    const auto sign = hn::And(det_middle, hn::Set(f, -0.0f));
    const auto w_middle = hn::Sub(hn::Sub(det_middle, u_middle), v_middle);
    const auto most =
        hn::Min(hn::Add(hn::Xor(u_middle, sign), u_off),
                hn::Min(hn::Add(hn::Xor(v_middle, sign), v_off), hn::Add(hn::Xor(w_middle, sign), w_off)));
    const auto last = hn::Set(f, last_time);
    const auto signed_time = hn::Xor(time, sign);
    const auto before_end = hn::Sub(hn::Mul(last, hn::Add(hn::Abs(det_middle), det_off)), signed_time);
    const auto end_error = hn::MulAdd(last, hn::Set(f, 2 * out.square), hn::Add(time_error, time_error));
    const auto outside = hn::Or(hn::Lt(most, hn::Neg(twice)), hn::Or(hn::Lt(signed_time, hn::Neg(time_error)),
                                                                     hn::Lt(before_end, hn::Neg(end_error))));
    const auto met = hn::Not(hn::And(known, outside));
    if (hn::AllFalse(f, met)) continue;
    result |= ray_bits(met) << i;
    for (std::uint32_t k = 0; k < 3; ++k) {
      hn::Store(det[k], f, out.det[k] + i);
      hn::Store(u[k], f, out.u[k] + i);
      hn::Store(v[k], f, out.v[k] + i);
    }
    hn::Store(time, f, out.time + i);
    hn::Store(error, f, out.error + i);
    hn::Store(time_error, f, out.time_error + i);
  }
  return result & ((1u << rows.count) - 1);
}

/// Follows packets through the boxes. What floats find is noted, and in the end put in order exactly.
class ClosestTrace {
 public:
  ClosestTrace(const SceneView& scene, const QueryOptions& options)
      : scene_(scene), filter_(scene, options.mask), is_on_(!options.skip && scene.bvh && !scene.bvh->empty()) {}

  /// Answers all rays, those that are no packet by alone(first, count).
  template <class Alone>
  void trace(const RaySpan& rays, Hit* out, Alone&& alone) {
    const DefaultFloatMode mode;
    std::size_t first_alone = 0, count = 0;
    for (std::size_t first = 0; first < rays.count; first += count) {
      count = std::min<std::size_t>(kRowLanes, rays.count - first);
      if (!is_on_ || count < kFewest || !packet_.read(rays, first, static_cast<std::uint32_t>(count), *scene_.tree))
        continue;
      if (first_alone < first) alone(first_alone, first - first_alone);
      first_alone = first + count;
      follow(rays, first, out + first);
    }
    if (first_alone < rays.count) alone(first_alone, rays.count - first_alone);
  }

 private:
  static constexpr std::size_t kFewest = 4;
  static constexpr std::uint32_t kMostNoted = 24;

  /// A triangle that some rays may hit, and when at the earliest.
  struct alignas(64) Noted {
    float earliest[kRowLanes];
    std::uint32_t id, lanes;
  };

  void follow(const RaySpan& rays, std::size_t first, Hit* out) {
    rays_ = &rays;
    first_ = first;
    noted_count_ = 0;
    for (std::uint32_t lane = 0; lane < packet_.count; ++lane) nearest_[lane] = Nearest();
    const auto rows = [&](const TriangleRows& triangles, float) {
      meet_row(triangles);
      return false;
    };
    NoCounts none;
    last_time_ = packet_.last_time;
    bvh_walk(*scene_.bvh, PacketTimes(packet_, last_time_), last_time_, rows, none);
    settle();
    for (std::uint32_t lane = 0; lane < packet_.count; ++lane) out[lane] = to_hit(scene_, nearest_[lane]);
  }

  HWY_INLINE void meet_row(const TriangleRows& rows) {
    bool nearer = false;
    for (std::uint32_t rest = look_at_row(packet_, rows, last_time_, seen_); rest != 0; rest &= rest - 1) {
      const std::uint32_t lane = first_lane(rest), id = rows.id[lane];
      if (!filter_.admits(id)) continue;
      Noted& noted = noted_[noted_count_];
      noted.id = id;
      // Where light may pass through a triangle, whether it is hit at all is asked at once.
      const bool is_solid = filter_.is_solid(id);
      noted.lanes = meet(lane, is_solid, noted.earliest, nearer);
      if (noted.lanes == 0) continue;
      if (!is_solid)
        nearer |= offer(noted);
      else if (++noted_count_ == kMostNoted)
        settle();
    }
    if (nearer) last_time_ = range_of(packet_.tmax).t1;
  }

  /// Rays that may hit the triangle before all that they surely hit, and when at the earliest. If it is solid, the rays
  /// that surely hit it now end there.
  HWY_INLINE std::uint32_t meet(std::uint32_t lane, bool is_solid, float (&earliest)[kRowLanes], bool& nearer) {
    const RayTag f;
    const auto error = hn::Set(f, seen_.error[lane]), time_error = hn::Set(f, seen_.time_error[lane]);
    const auto square = hn::Set(f, seen_.square);
    std::uint32_t result = 0;
    for (std::uint32_t i = 0; i < kRowLanes; i += static_cast<std::uint32_t>(hn::Lanes(f))) {
      const auto product = [&](const float(&row)[3][kRowLanes]) {
        const auto x = hn::Load(f, packet_.direction[0] + i), y = hn::Load(f, packet_.direction[1] + i);
        return hn::MulAdd(hn::Load(f, packet_.direction[2] + i), hn::Set(f, row[2][lane]),
                          hn::MulAdd(y, hn::Set(f, row[1][lane]), hn::Mul(x, hn::Set(f, row[0][lane]))));
      };
      const auto signed_det = product(seen_.det);
      const auto sign = hn::And(signed_det, hn::Set(f, -0.0f));
      const auto det = hn::Abs(signed_det);
      const auto u = hn::Xor(product(seen_.u), sign), v = hn::Xor(product(seen_.v), sign);
      const auto smallest = hn::Min(hn::Min(u, v), hn::Sub(hn::Sub(det, u), v));
      auto open = hn::Ge(smallest, hn::Mul(error, hn::Set(f, kMissFactor)));
      if (hn::AllFalse(f, open)) continue;
      const auto tmin = hn::Load(f, packet_.tmin + i), tmax = hn::Load(f, packet_.tmax + i);
      const auto time = hn::Xor(hn::Set(f, seen_.time[lane]), sign);
      const auto after_start = hn::Sub(time, hn::Mul(tmin, det)), before_end = hn::Sub(hn::Mul(tmax, det), time);
      const auto start_error = hn::MulAdd(square, tmin, time_error), end_error = hn::MulAdd(square, tmax, time_error);
      const auto outside = hn::Or(hn::Lt(after_start, hn::Neg(start_error)), hn::Lt(before_end, hn::Neg(end_error)));
      const auto sided = hn::Gt(det, error);
      open = hn::AndNot(hn::And(sided, outside), open);
      result |= ray_bits(open) << i;
      // Three roundings each.
      const auto low = hn::Mul(hn::Div(hn::Sub(time, time_error), hn::Add(det, error)), hn::Set(f, 1 - 0x1p-20f));
      hn::Store(hn::IfThenElseZero(sided, low), f, earliest + i);
      if (!is_solid) continue;
      const auto hit =
          hn::And(hn::Gt(smallest, error), hn::And(hn::Gt(after_start, start_error), hn::Gt(before_end, end_error)));
      if (hn::AllFalse(f, hit)) continue;
      nearer = true;
      const auto high = hn::Mul(hn::Div(hn::Add(time, time_error), hn::Sub(det, error)), hn::Set(f, 1 + 0x1p-20f));
      hn::Store(hn::IfThenElse(hit, hn::Min(tmax, high), tmax), f, packet_.tmax + i);
    }
    return result & ((1u << packet_.count) - 1);
  }

  /// Puts what was noted in order, by the exact answers.
  void settle() {
    for (std::uint32_t i = 0; i < noted_count_; ++i) offer(noted_[i]);
    noted_count_ = 0;
  }

  /// Returns whether some ray now ends earlier.
  bool offer(const Noted& noted) {
    const RayTag f;
    std::uint32_t early = 0;
    for (std::uint32_t i = 0; i < kRowLanes; i += static_cast<std::uint32_t>(hn::Lanes(f)))
      early |= ray_bits(hn::Le(hn::Load(f, noted.earliest + i), hn::Load(f, packet_.tmax + i))) << i;
    bool nearer = false;
    NoCounts none;
    for (std::uint32_t rest = early & noted.lanes; rest != 0; rest &= rest - 1) {
      const std::uint32_t lane = first_lane(rest);
      if (!nearest_[lane].offer(scene_, filter_, (*rays_)[first_ + lane], noted.id, none)) continue;
      const float end = time_after(nearest_[lane].hit, packet_.time_scale);
      nearer |= end < packet_.tmax[lane];
      packet_.tmax[lane] = std::min(packet_.tmax[lane], end);
    }
    return nearer;
  }

  const SceneView& scene_;
  Filter filter_;
  bool is_on_;
  ClosestPacket packet_;
  float last_time_ = 0;
  PacketTriangles seen_;
  const RaySpan* rays_ = nullptr;
  std::size_t first_ = 0;
  Nearest nearest_[kRowLanes];
  Noted noted_[kMostNoted];
  std::uint32_t noted_count_ = 0;
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
