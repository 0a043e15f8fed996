// SPDX-License-Identifier: Apache-2.0
// Bundles against the triangles that their shaft may meet, as their start s sees both. For A, B, C as offsets from s
// and a ray to s + F: it passes A and B on the side of (A x (B - A)) . F, all three of its sides being that of
// N . A if it goes through the triangle, before its end if N . F > N . A (with N . A > 0, N of length 1).
// With e = 2^-24, eight roundings and the permanent of three vectors being at most 2/sqrt(3) of the product of their
// lengths, an edge is wrong by less than 10 e |A| |B - A| |F|; a normal's product, of five roundings, by 6 e |A| or
// 6 e |F|. Middles and halves of boxes of F take two more.

#if defined(UMBRIX_KERNELS_SHAFT_PACKETS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_SHAFT_PACKETS_INL_H_
#undef UMBRIX_KERNELS_SHAFT_PACKETS_INL_H_
#else
#define UMBRIX_KERNELS_SHAFT_PACKETS_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <limits>

#include "kernels/bundle_hull-inl.h"
#include "kernels/group_rays.h"
#include "kernels/ray_lanes-inl.h"
#include "kernels/shaft.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

/// Triangles of a row as a start sees them; of those whose side is known, with that sign taken out.
struct alignas(64) SeenTriangles {
  float edge[3][3][kRowLanes];  ///< by edge and coefficient
  float normal[3][kRowLanes];
  float plane[kRowLanes];  ///< N . A
  float edge_error[kRowLanes], plane_error[kRowLanes];
};

struct SeenLanes {
  std::uint32_t met = 0;      ///< may block some ray
  std::uint32_t blocks = 0;   ///< surely block all rays
  std::uint32_t edge_on = 0;  ///< of those met: no side is known
};

/// Lanes of a bundle's rays.
struct RayHits {
  std::uint32_t hit = 0, unsure = 0;
};

/// A bundle's rays side by side.
class BundleView {
 public:
  explicit BundleView(const RayBundle& b) : bundle_(b) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      middle_[k] = 0.5f * (b.low[k] + b.high[k]);
      half_[k] = 0.5f * (b.high[k] - b.low[k]);
      length_ += std::max(-b.low[k], b.high[k]);
    }
  }

  /// Which of some triangles the rays may meet, none of them farther than `reach`; of these `out` is filled.
  HWY_INLINE SeenLanes look(const TriangleRows& rows, std::uint32_t wanted, float reach, SeenTriangles& out) const {
    const RayTag f;
    SeenLanes result;
    for (std::uint32_t i = 0; i < kRowLanes; i += static_cast<std::uint32_t>(hn::Lanes(f)))
      look_at(rows, reach, i, out, result);
    result.met &= wanted;
    return result;
  }

  /// A triangle of a row against the rays.
  HWY_INLINE RayHits meet(const SeenTriangles& t, std::uint32_t lane, bool edge_on) const {
    const RayTag f;
    RayHits result;
    const auto edge_error = hn::Set(f, t.edge_error[lane]);
    for (std::uint32_t i = 0; i < kRowLanes; i += static_cast<std::uint32_t>(hn::Lanes(f))) {
      const auto x = hn::Load(f, bundle_.far[0] + i), y = hn::Load(f, bundle_.far[1] + i),
                 z = hn::Load(f, bundle_.far[2] + i);
      const auto product = [&](const float(&row)[3][kRowLanes]) {
        return hn::MulAdd(z, hn::Set(f, row[2][lane]),
                          hn::MulAdd(y, hn::Set(f, row[1][lane]), hn::Mul(x, hn::Set(f, row[0][lane]))));
      };
      const auto e0 = product(t.edge[0]), e1 = product(t.edge[1]), e2 = product(t.edge[2]);
      const auto least = hn::Min(e0, hn::Min(e1, e2));
      const auto within = hn::Ge(least, hn::Neg(edge_error));
      if (HWY_UNLIKELY(edge_on)) {
        const auto apart = hn::AndNot(within, hn::Gt(hn::Max(e0, hn::Max(e1, e2)), edge_error));
        result.unsure |= ray_bits(hn::Not(apart)) << i;
        continue;
      }
      const auto plane_error = hn::Set(f, t.plane_error[lane]);
      const auto end = product(t.normal), plane = hn::Set(f, t.plane[lane]);
      auto inside = hn::Sub(end, plane);  // of the interval
      if (HWY_UNLIKELY(bundle_.has_begin))
        inside = hn::Min(inside, hn::NegMulAdd(hn::Load(f, bundle_.begin + i), end, plane));
      const auto hit = hn::And(hn::Gt(least, edge_error), hn::Gt(inside, plane_error));
      const auto open = hn::And(within, hn::Ge(inside, hn::Neg(plane_error)));
      result.hit |= ray_bits(hit) << i;
      result.unsure |= ray_bits(hn::AndNot(hit, open)) << i;
    }
    return result;
  }

  const RayBundle& bundle() const { return bundle_; }

 private:
  HWY_INLINE void look_at(const TriangleRows& rows, float reach, std::uint32_t i, SeenTriangles& out,
                          SeenLanes& result) const {
    const RayTag f;
    const auto zero = hn::Zero(f), negative = hn::Set(f, -0.0f);
    RayVec edge[3][3], normal[3], vertex[3][3], offset[3][3];
    auto plane = zero, end = zero, end_off = zero;
    for (std::uint32_t k = 0; k < 3; ++k) {
      for (std::uint32_t v = 0; v < 3; ++v) {
        vertex[v][k] = hn::Load(f, rows.v[v][k] + i);
        offset[v][k] = hn::Sub(vertex[v][k], hn::Set(f, bundle_.start[k]));
      }
    }
    for (std::uint32_t k = 0; k < 3; ++k) {
      normal[k] = hn::Load(f, rows.normal[k] + i);
      plane = hn::MulAdd(normal[k], offset[0][k], plane);
      end = hn::MulAdd(normal[k], hn::Set(f, middle_[k]), end);
      end_off = hn::MulAdd(hn::Abs(normal[k]), hn::Set(f, half_[k]), end_off);
    }
    const auto known = hn::Gt(hn::Abs(plane), hn::Set(f, kPlaneError * reach + kTiny));
    const auto sign = hn::IfThenElseZero(known, hn::And(plane, negative));
    const auto edge_error =
        hn::MulAdd(hn::Load(f, rows.longest + i), hn::Set(f, kEdgeError * reach * length_), hn::Set(f, kTiny));
    const auto plane_error = hn::Set(f, kPlaneError * (reach + length_) + kTiny);
    const auto before = hn::Sub(hn::Xor(end, sign), hn::Abs(plane));
    const auto open = hn::Or(hn::Not(known), hn::Ge(hn::Add(before, end_off), hn::Neg(plane_error)));
    if (hn::AllFalse(f, open)) return;

    auto least_high = hn::Set(f, std::numeric_limits<float>::infinity()), least_low = least_high;
    auto most_low = hn::Neg(least_high);
    for (std::uint32_t e = 0; e < 3; ++e) {
      RayVec along[3];
      for (std::uint32_t k = 0; k < 3; ++k) along[k] = hn::Sub(vertex[(e + 1) % 3][k], vertex[e][k]);
      auto middle = zero, off = edge_error;
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t k1 = (k + 1) % 3, k2 = (k + 2) % 3;
        const auto x = hn::MulSub(offset[e][k1], along[k2], hn::Mul(offset[e][k2], along[k1]));
        edge[e][k] = hn::Xor(x, sign);
        middle = hn::MulAdd(edge[e][k], hn::Set(f, middle_[k]), middle);
        off = hn::MulAdd(hn::Abs(x), hn::Set(f, half_[k]), off);
      }
      least_high = hn::Min(least_high, hn::Add(middle, off));
      least_low = hn::Min(least_low, hn::Sub(middle, off));
      most_low = hn::Max(most_low, hn::Sub(middle, off));
    }
    // Without a known side a triangle is missed if two of its edges are passed on different sides.
    const auto outside = hn::Lt(least_high, zero);
    const auto apart = hn::And(outside, hn::Or(known, hn::Gt(most_low, zero)));
    const auto met = hn::AndNot(apart, open);
    if (hn::AllFalse(f, met)) return;
    result.met |= ray_bits(met) << i;
    result.edge_on |= ray_bits(hn::AndNot(known, met)) << i;
    const auto blocks = hn::And(hn::And(known, hn::Gt(least_low, zero)), hn::Gt(hn::Sub(before, end_off), plane_error));
    result.blocks |= ray_bits(blocks) << i;
    for (std::uint32_t k = 0; k < 3; ++k) {
      for (std::uint32_t e = 0; e < 3; ++e) hn::Store(edge[e][k], f, out.edge[e][k] + i);
      hn::Store(hn::Xor(normal[k], sign), f, out.normal[k] + i);
    }
    hn::Store(hn::Abs(plane), f, out.plane + i);
    hn::Store(edge_error, f, out.edge_error + i);
    hn::Store(plane_error, f, out.plane_error + i);
  }

  static constexpr float kEdgeError = 16 * 0x1p-24f, kPlaneError = 10 * 0x1p-24f;
  static constexpr float kTiny = 0x1p-100f;

  const RayBundle& bundle_;
  float middle_[3], half_[3];  ///< of the box of the rays' ends, from their start
  float length_ = 0;           ///< no ray is longer, as a 1-norm
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
