// SPDX-License-Identifier: Apache-2.0
// One ray against the triangles of a leaf side by side: Moeller & Trumbore (1997) with the origin moved to a
// vertex, filtered after Shewchuk (1997). For s = o - v0 and D, S, Eb bounding |d|, |s| and the edges,
//   E  = k D Eb (2 S + Eb)          bounds the errors of det, U, V and W,
//   EA = k Eb^2 (S + |t| D)         bounds that of T - t det,          k = 10.5 * 2^-24,
// since a 3x3 permanent is at most 2/sqrt(3) times the product of the norms. What this bound of the block leaves open
// gets bounds of its own (permanents), then double, then integers. Contraction to fma only removes roundings.

#if defined(UMBRIX_KERNELS_LEAF_TEST_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_LEAF_TEST_INL_H_
#undef UMBRIX_KERNELS_LEAF_TEST_INL_H_
#else
#define UMBRIX_KERNELS_LEAF_TEST_INL_H_
#endif

#include <hwy/highway.h>

#include "index/triangle_bvh.h"
#include "kernels/lane_vectors-inl.h"
#include "kernels/scene_view.h"
#include "kernels/walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

using Lanes8 = hn::CappedTag<float, kBlockLanes>;
using FloatVec = hn::Vec<Lanes8>;
using FloatMask = hn::Mask<Lanes8>;

inline constexpr float kUnit = 0x1p-24f;
inline constexpr float kNormBound = 10.5f * kUnit;
inline constexpr float kPermanentBound = 9.5f * kUnit;
inline constexpr float kMissFactor = -2.0002f;
// What may be lost to underflow and flush-to-zero in the tree's units, many times over.
inline constexpr float kTinyEdge = 0x1p-90f;
inline constexpr float kTinyTime = 0x1p-80f;

/// Lanes as bits, of a whole block.
struct LaneBits {
  std::uint32_t hit = 0;  ///< surely hit
  std::uint32_t undecided = 0;
};

/// One bit a lane.
template <class D>
HWY_INLINE std::uint32_t mask_bits(D f, hn::Mask<D> mask) {
  alignas(8) std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(f, mask, bytes);
  return static_cast<std::uint32_t>(bytes[0]) | static_cast<std::uint32_t>(bytes[1]) << 8;
}
inline std::uint32_t bits_of(FloatMask mask) { return mask_bits(Lanes8(), mask); }

template <class D, std::size_t kLanes>
HWY_INLINE LaneVectors<D> load_lanes(D f, const float (&rows)[3][kLanes], std::uint32_t lane) {
  return {hn::Load(f, rows[0] + lane), hn::Load(f, rows[1] + lane), hn::Load(f, rows[2] + lane)};
}

/// A triangle's first vertex and the edges from it, each rounded once.
template <class D>
struct LaneTriangles {
  LaneVectors<D> v0, e1, e2;
};
template <class D>
HWY_INLINE LaneTriangles<D> load_triangles(D f, const Block& block, std::uint32_t lane) {
  return {load_lanes(f, block.v0, lane), load_lanes(f, block.e1, lane), load_lanes(f, block.e2, lane)};
}
template <class D>
HWY_INLINE LaneTriangles<D> load_triangles(D f, const TriangleRows& rows, std::uint32_t lane) {
  const LaneVectors<D> v0 = load_lanes(f, rows.v[0], lane);
  return {v0, minus(load_lanes(f, rows.v[1], lane), v0), minus(load_lanes(f, rows.v[2], lane), v0)};
}

/// Lanes whose triangle is surely hit, or surely not in time.
template <class D>
struct TimedLanes {
  hn::Mask<D> hit, missed;
};

/// From how far inside the edges a ray passes, and how far inside its interval, det being above 0, and their bounds.
template <class D>
HWY_INLINE TimedLanes<D> time_lanes(D, hn::Vec<D> smallest, hn::Vec<D> det, hn::Vec<D> after_start,
                                    hn::Vec<D> before_end, hn::Vec<D> error, hn::Vec<D> start_error,
                                    hn::Vec<D> end_error) {
  const auto outside = hn::Or(hn::Lt(after_start, hn::Neg(start_error)), hn::Lt(before_end, hn::Neg(end_error)));
  return {hn::And(hn::Gt(smallest, error), hn::And(hn::Gt(after_start, start_error), hn::Gt(before_end, end_error))),
          hn::And(hn::Gt(det, error), outside)};
}

/// The ray's values in every lane, and the bounds that depend on the ray alone. Triangles are so many side by side.
template <class Triangles, std::uint32_t kLanes>
class LaneTest {
  using Lanes = hn::CappedTag<float, kLanes>;
  using Floats = hn::Vec<Lanes>;
  using Mask = hn::Mask<Lanes>;

 public:
  explicit LaneTest(const WalkRay& ray)
      : ray_(ray), edge_factor_(kNormBound * ray.length), start_reach_(std::abs(ray.tmin) * ray.length) {
    const Lanes f;
    for (int k = 0; k < 3; ++k) {
      origin_[k] = hn::Set(f, ray.origin[k]);
      direction_[k] = hn::Set(f, ray.direction[k]);
    }
  }

  /// How far the first vertices in a leaf's block can be from the origin of a ray that is in the leaf at time `t`.
  HWY_INLINE float reach(const Triangles& block, float t) const { return std::abs(t) * ray_.length + block.reach; }

  /// Tests a block none of whose first vertices is farther than `reach` from the origin, for hits before `tmax`.
  HWY_INLINE LaneBits operator()(const Triangles& block, float reach, float tmax) const {
    LaneBits result;
    const Lanes f;
    const float error = edge_factor_ * block.edge_bound * (2 * reach + block.edge_bound) + kTinyEdge;
    const auto reject_below = hn::Set(f, kMissFactor * error);
    for (std::uint32_t lane = 0; lane < kLanes; lane += static_cast<std::uint32_t>(hn::Lanes(f))) {
      const LaneTriangles<Lanes> triangles = load_triangles(f, block, lane);
      const Values x = evaluate(triangles);
      const auto smallest = hn::Min(hn::Min(x.u, x.v), x.w);
      const auto open = hn::Ge(smallest, reject_below);
      if (HWY_LIKELY(hn::AllFalse(f, open))) continue;
      decide_times(triangles, block.edge_bound, lane, x, smallest, open, error, reach, tmax, result);
    }
    const std::uint32_t in_use = (1u << block.count) - 1;
    result.hit &= in_use;
    result.undecided &= in_use;
    return result;
  }

  /// Sharper bounds, lane by lane, for what the block's bound left open. Only `lanes` are looked at.
  HWY_NOINLINE LaneBits with_permanents(const Triangles& block, std::uint32_t lanes) const {
    LaneBits result;
    const Lanes f;
    for (std::uint32_t lane = 0; lane < kLanes; lane += static_cast<std::uint32_t>(hn::Lanes(f)))
      decide_by_permanents(load_triangles(f, block, lane), lane, result);
    result.hit &= lanes;
    result.undecided &= lanes;
    return result;
  }

 private:
  /// det without its sign, and U, V, W and T with that sign taken out. T is completed on demand.
  struct Values {
    Floats det, u, v, w;
    Floats sign;
    Floats q[3];
  };

  static Floats dot(Floats ax, Floats ay, Floats az, Floats bx, Floats by, Floats bz) {
    return hn::MulAdd(az, bz, hn::MulAdd(ay, by, hn::Mul(ax, bx)));
  }
  static Floats cross_term(Floats a, Floats b, Floats c, Floats d) { return hn::MulSub(a, b, hn::Mul(c, d)); }

  HWY_INLINE Values evaluate(const LaneTriangles<Lanes>& triangles) const {
    const Lanes f;
    const auto [e1x, e1y, e1z] = triangles.e1;
    const auto [e2x, e2y, e2z] = triangles.e2;
    const auto sx = hn::Sub(origin_[0], triangles.v0.x);
    const auto sy = hn::Sub(origin_[1], triangles.v0.y);
    const auto sz = hn::Sub(origin_[2], triangles.v0.z);
    const auto px = cross_term(direction_[1], e2z, direction_[2], e2y);
    const auto py = cross_term(direction_[2], e2x, direction_[0], e2z);
    const auto pz = cross_term(direction_[0], e2y, direction_[1], e2x);
    const auto det = dot(e1x, e1y, e1z, px, py, pz);
    Values x;
    x.q[0] = cross_term(sy, e1z, sz, e1y);
    x.q[1] = cross_term(sz, e1x, sx, e1z);
    x.q[2] = cross_term(sx, e1y, sy, e1x);
    x.sign = hn::And(det, hn::Set(f, -0.0f));
    x.det = hn::Abs(det);
    x.u = hn::Xor(dot(sx, sy, sz, px, py, pz), x.sign);
    x.v = hn::Xor(dot(direction_[0], direction_[1], direction_[2], x.q[0], x.q[1], x.q[2]), x.sign);
    x.w = hn::Sub(hn::Sub(x.det, x.u), x.v);
    return x;
  }

  HWY_INLINE Floats time_numerator(const LaneTriangles<Lanes>& triangles, const Values& x) const {
    return hn::Xor(dot(triangles.e2.x, triangles.e2.y, triangles.e2.z, x.q[0], x.q[1], x.q[2]), x.sign);
  }

  HWY_INLINE void decide_times(const LaneTriangles<Lanes>& triangles, float edge_bound, std::uint32_t lane,
                               const Values& x, Floats smallest, Mask open, float error, float reach, float tmax,
                               LaneBits& result) const {
    const Lanes f;
    const float square = kNormBound * edge_bound * edge_bound;
    const float start_error = square * (reach + start_reach_) + kTinyTime;
    const float end_error = square * (reach + std::abs(tmax) * ray_.length) + kTinyTime;
    const auto t = time_numerator(triangles, x);
    const auto after_start = hn::Sub(t, hn::Mul(hn::Set(f, ray_.tmin), x.det));
    const auto before_end = hn::Sub(hn::Mul(hn::Set(f, tmax), x.det), t);
    const TimedLanes<Lanes> timed = time_lanes(f, smallest, x.det, after_start, before_end, hn::Set(f, error),
                                               hn::Set(f, start_error), hn::Set(f, end_error));
    const std::uint32_t hit_bits = mask_bits(f, timed.hit);
    result.hit |= hit_bits << lane;
    result.undecided |= (mask_bits(f, hn::AndNot(timed.missed, open)) & ~hit_bits) << lane;
  }

  static Floats abs_dot(Floats ax, Floats ay, Floats az, Floats bx, Floats by, Floats bz) {
    return dot(hn::Abs(ax), hn::Abs(ay), hn::Abs(az), bx, by, bz);
  }
  static Floats abs_cross_term(Floats a, Floats b, Floats c, Floats d) {
    return hn::Add(hn::Abs(hn::Mul(a, b)), hn::Abs(hn::Mul(c, d)));
  }

  void decide_by_permanents(const LaneTriangles<Lanes>& triangles, std::uint32_t lane, LaneBits& result) const {
    const Lanes f;
    const Values x = evaluate(triangles);
    const auto t = time_numerator(triangles, x);
    const auto [e1x, e1y, e1z] = triangles.e1;
    const auto [e2x, e2y, e2z] = triangles.e2;
    const auto sx = hn::Sub(origin_[0], triangles.v0.x);
    const auto sy = hn::Sub(origin_[1], triangles.v0.y);
    const auto sz = hn::Sub(origin_[2], triangles.v0.z);
    const auto px = abs_cross_term(direction_[1], e2z, direction_[2], e2y);
    const auto py = abs_cross_term(direction_[2], e2x, direction_[0], e2z);
    const auto pz = abs_cross_term(direction_[0], e2y, direction_[1], e2x);
    const auto qx = abs_cross_term(sy, e1z, sz, e1y);
    const auto qy = abs_cross_term(sz, e1x, sx, e1z);
    const auto qz = abs_cross_term(sx, e1y, sy, e1x);
    const auto det = abs_dot(e1x, e1y, e1z, px, py, pz);
    const auto u = abs_dot(sx, sy, sz, px, py, pz);
    const auto v = abs_dot(direction_[0], direction_[1], direction_[2], qx, qy, qz);
    const auto time = abs_dot(e2x, e2y, e2z, qx, qy, qz);

    const auto factor = hn::Set(f, kPermanentBound);
    const auto e = hn::MulAdd(factor, hn::Add(hn::Add(det, u), v), hn::Set(f, kTinyEdge));
    const auto ea = hn::MulAdd(factor, hn::MulAdd(hn::Set(f, std::abs(ray_.tmin)), det, time), hn::Set(f, kTinyTime));
    const auto eb = hn::MulAdd(factor, hn::MulAdd(hn::Set(f, std::abs(ray_.tmax)), det, time), hn::Set(f, kTinyTime));
    const auto smallest = hn::Min(hn::Min(x.u, x.v), x.w);
    const auto after_start = hn::Sub(t, hn::Mul(hn::Set(f, ray_.tmin), x.det));
    const auto before_end = hn::Sub(hn::Mul(hn::Set(f, ray_.tmax), x.det), t);
    const TimedLanes<Lanes> timed = time_lanes(f, smallest, x.det, after_start, before_end, e, ea, eb);
    const auto missed = hn::Or(hn::Lt(smallest, hn::Mul(e, hn::Set(f, kMissFactor))), timed.missed);
    result.hit |= mask_bits(f, timed.hit) << lane;
    result.undecided |= (~(mask_bits(f, timed.hit) | mask_bits(f, missed)) & ((1u << hn::Lanes(f)) - 1)) << lane;
  }

  const WalkRay& ray_;
  float edge_factor_;
  float start_reach_;
  Floats origin_[3];
  Floats direction_[3];
};

using LeafTest = LaneTest<Block, kBlockLanes>;
using RowTest = LaneTest<TriangleRows, kRowLanes>;

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
