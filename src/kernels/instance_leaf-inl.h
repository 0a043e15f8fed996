// SPDX-License-Identifier: Apache-2.0
// A leaf of a prototype: its triangles are placed in the world, in lanes as placed() does, and those are left out that
// the ray surely misses. The test is that of leaf_test-inl.h in double, with the same bounds for double's unit:
// vertices are floats, so nothing is lost before, and nothing can over- or underflow.

#if defined(UMBRIX_KERNELS_INSTANCE_LEAF_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_INSTANCE_LEAF_INL_H_
#undef UMBRIX_KERNELS_INSTANCE_LEAF_INL_H_
#else
#define UMBRIX_KERNELS_INSTANCE_LEAF_INL_H_
#endif

#include <hwy/highway.h>

#include "core/transform.h"
#include "index/instance_tree.h"
#include "kernels/lane_vectors-inl.h"
#include "kernels/local_ray-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

/// As rows hold it, in the world.
inline Triangle placed_triangle(const PlacedInstance& instance, const TriangleRows& rows, std::uint32_t lane) {
  Triangle t;
  for (int i = 0; i < 3; ++i)
    t.v[i] = placed(instance.to_world, Vec3(rows.v[i][0][lane], rows.v[i][1][lane], rows.v[i][2][lane]));
  return t;
}

class InstanceLeaf {
 public:
  InstanceLeaf(const PlacedInstance& instance, const WorldRay& ray) : instance_(instance), ray_(ray) {
    const double unit = 10.6 * 0x1p-53;  // and a little for the rounding of the bounds
    const double reach = ray.origin_norm + instance.reach, edge = instance.edge;
    error_ = unit * ray.direction_norm * edge * (2 * reach + edge);
    square_ = unit * edge * edge;
    reach_ = reach;
  }

  /// The triangles that the ray may hit before `tmax`, by lane.
  HWY_INLINE std::uint32_t candidates(const TriangleRows& rows, double tmax) const {
    std::uint32_t result = 0;
    for (std::uint32_t lane = 0; lane < rows.count; lane += static_cast<std::uint32_t>(hn::Lanes(Lanes())))
      result |= candidates_from(rows, lane, tmax) << lane;
    return result & ((1u << rows.count) - 1);
  }

 private:
  using Lanes = hn::CappedTag<double, 8>;
  using Doubles = hn::Vec<Lanes>;

  using Point = LaneVectors<Lanes>;

  HWY_INLINE Doubles place(int row, const Point& p) const {
    const Lanes d;
    const hn::Rebind<float, Lanes> f;
    const double(&m)[4] = instance_.to_world[row];
    const auto sum = hn::Add(hn::Add(hn::Add(hn::Mul(hn::Set(d, m[0]), p.x), hn::Mul(hn::Set(d, m[1]), p.y)),
                                     hn::Mul(hn::Set(d, m[2]), p.z)),
                             hn::Set(d, m[3]));
    return hn::PromoteTo(d, hn::DemoteTo(f, sum));
  }

  HWY_INLINE Point vertex(const float (&v)[3][kRowLanes], std::uint32_t lane) const {
    const Lanes d;
    const hn::Rebind<float, Lanes> f;
    const Point local = {hn::PromoteTo(d, hn::Load(f, v[0] + lane)), hn::PromoteTo(d, hn::Load(f, v[1] + lane)),
                         hn::PromoteTo(d, hn::Load(f, v[2] + lane))};
    return {place(0, local), place(1, local), place(2, local)};
  }

  static HWY_INLINE Point all(const double (&v)[3]) {
    const Lanes d;
    return {hn::Set(d, v[0]), hn::Set(d, v[1]), hn::Set(d, v[2])};
  }

  HWY_INLINE std::uint32_t candidates_from(const TriangleRows& rows, std::uint32_t lane, double tmax) const {
    const Lanes d;
    const Point v0 = vertex(rows.v[0], lane);
    const Point e1 = minus(vertex(rows.v[1], lane), v0), e2 = minus(vertex(rows.v[2], lane), v0);
    const Point s = minus(all(ray_.origin), v0), direction = all(ray_.direction);
    const Point p = cross(direction, e2), q = cross(s, e1);
    const auto signed_det = dot(e1, p);
    const auto sign = hn::And(signed_det, hn::Set(d, -0.0));
    const auto det = hn::Abs(signed_det);
    const auto u = hn::Xor(dot(s, p), sign), v = hn::Xor(dot(direction, q), sign);
    const auto w = hn::Sub(hn::Sub(det, u), v);
    const auto open = hn::Ge(hn::Min(hn::Min(u, v), w), hn::Set(d, -2.0002 * error_));
    if (HWY_LIKELY(hn::AllFalse(d, open))) return 0;

    // An end at infinity makes the bound infinite, or the difference NaN: neither is outside.
    const double start_error = square_ * (reach_ + std::abs(ray_.tmin) * ray_.direction_norm);
    const double end_error = square_ * (reach_ + std::abs(tmax) * ray_.direction_norm);
    const auto t = hn::Xor(dot(e2, q), sign);
    const auto before = hn::Lt(hn::Sub(t, hn::Mul(hn::Set(d, ray_.tmin), det)), hn::Set(d, -start_error));
    const auto after = hn::Lt(hn::Sub(hn::Mul(hn::Set(d, tmax), det), t), hn::Set(d, -end_error));
    const auto missed = hn::And(hn::Gt(det, hn::Set(d, error_)), hn::Or(before, after));
    alignas(8) std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, hn::AndNot(missed, open), bits);
    return bits[0];
  }

  const PlacedInstance& instance_;
  const WorldRay& ray_;
  double error_, square_, reach_;
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
