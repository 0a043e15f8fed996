// SPDX-License-Identifier: Apache-2.0
// Triangles as a light sees them. For A, B, C as offsets from the light, a start at m r (r = (u, v, 1) on the face's
// axes, m its depth, w = 1/m) and N the triangle's normal:
//   the line from the start to the light passes A and B on the side of (A x (B - A)) . r,
//   and the triangle's plane lies before the start if N . r / (N . A) > w.
// Offsets and r are rounded by up to 2 and 6 units e = 2^-24, |r| <= sqrt(3), and the permanent of three vectors is at
// most 2/sqrt(3) of the product of their lengths. With each coordinate of a start off by up to s m and of its end by up
// to l m, which moves an edge's triple product by the light's offset times (B - A) x (S - A),
//   an edge is wrong by less than |E| (|A| (32 e + 1.8 (s + l)) + 3.1 l m),
//   N . r by (24 e + 1.8 s) |E||F|, (N . A) w by 14 e |A| |E||F| w, for edges E and F and the nearest vertex A,
// and if |N . A| > 4 |E||F| (11 e |A| + 1.8 l m), the light is on the side that its sign tells.

#if defined(UMBRIX_KERNELS_LIGHT_TRIANGLES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_LIGHT_TRIANGLES_INL_H_
#undef UMBRIX_KERNELS_LIGHT_TRIANGLES_INL_H_
#else
#define UMBRIX_KERNELS_LIGHT_TRIANGLES_INL_H_
#endif

#include <hwy/highway.h>

#include <limits>

#include "kernels/lane_vectors-inl.h"
#include "kernels/light_view.h"
#include "kernels/ray_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

using LaneVec3 = LaneVectors<RayTag>;

/// A bound of the length.
HWY_INLINE RayVec length(const LaneVec3& a) { return hn::Mul(hn::Sqrt(dot(a, a)), hn::Set(RayTag(), 1 + 0x1p-20f)); }

/// Which of rows and boxes are starts, the other being what may block them.
enum class Starts { in_rows, in_box };

/// Lanes whose rectangles meet the box's, where the blocker's nearest point is no farther than the farthest start.
template <Starts kStarts>
HWY_INLINE std::uint32_t meeting(const ViewRows& rows, const ViewBox& box) {
  const RayTag f;
  std::uint32_t result = 0;
  for (std::uint32_t i = 0; i < kRowLanes; i += static_cast<std::uint32_t>(hn::Lanes(f))) {
    const auto row = [&](ViewRows::Row r) { return hn::Load(f, rows.rows[r] + i); };
    const auto in_u = hn::And(hn::Le(row(ViewRows::low_u), hn::Set(f, box.high_u)),
                              hn::Ge(row(ViewRows::high_u), hn::Set(f, box.low_u)));
    const auto in_v = hn::And(hn::Le(row(ViewRows::low_v), hn::Set(f, box.high_v)),
                              hn::Ge(row(ViewRows::high_v), hn::Set(f, box.low_v)));
    const auto depth = hn::Set(f, box.depth);
    const auto is_before =
        kStarts == Starts::in_rows ? hn::Le(row(ViewRows::depth), depth) : hn::Ge(row(ViewRows::depth), depth);
    result |= ray_bits(hn::And(hn::And(in_u, in_v), is_before)) << i;
  }
  return result;
}

/// Bounds of values that grow with `scale`, of LightTriangles::edge_error or plane_error, from lane i on.
HWY_INLINE RayVec error_bound(const float (&rows)[2][kRowLanes], std::uint32_t i, float scale) {
  const RayTag f;
  return hn::MulAdd(hn::Load(f, rows[1] + i), hn::Set(f, scale), hn::Load(f, rows[0] + i));
}

/// Sixteen triangles and one light.
class TriangleLanes {
 public:
  TriangleLanes(const TriangleRows& rows, const Face& face, const LightPoint& light, const ViewErrors& errors)
      : rows_(rows), face_(face), light_(light), errors_(errors) {}

  /// Rectangles and nearest points on a face: a triangle that spans it or comes too near has no bounds.
  void bound(ViewRows& out) const {
    const RayTag f;
    const auto infinity = hn::Set(f, std::numeric_limits<float>::infinity());
    const auto off = hn::Set(f, errors_.most);
    for (std::uint32_t i = 0; i < kRowLanes; i += static_cast<std::uint32_t>(hn::Lanes(f))) {
      auto low_u = infinity, low_v = infinity, high_u = hn::Neg(infinity), high_v = high_u, least = infinity;
      for (std::uint32_t vertex = 0; vertex < 3; ++vertex) {
        const auto m = hn::Mul(offset(vertex, face_.axis, i), hn::Set(f, face_.sign));
        const auto w = hn::Div(hn::Set(f, 1.0f), m);
        const auto u = hn::Mul(offset(vertex, face_.u_axis(), i), w), v = hn::Mul(offset(vertex, face_.v_axis(), i), w);
        least = hn::Min(least, m);
        low_u = hn::Min(low_u, u);
        high_u = hn::Max(high_u, u);
        low_v = hn::Min(low_v, v);
        high_v = hn::Max(high_v, v);
      }
      const auto bounded = hn::Gt(least, hn::Mul(off, hn::Set(f, 4.0f)));
      const auto w = hn::Div(hn::Set(f, 1 + 0x1p-18f), least);
      const auto margin = hn::MulAdd(hn::Mul(off, hn::Set(f, 2.2f)), w, hn::Set(f, 0x1p-19f));
      const auto put = [&](ViewRows::Row row, RayVec x, RayVec otherwise) {
        hn::Store(hn::IfThenElse(bounded, x, otherwise), f, out.rows[row] + i);
      };
      put(ViewRows::low_u, hn::Sub(low_u, margin), hn::Neg(infinity));
      put(ViewRows::high_u, hn::Add(high_u, margin), infinity);
      put(ViewRows::low_v, hn::Sub(low_v, margin), hn::Neg(infinity));
      put(ViewRows::high_v, hn::Add(high_v, margin), infinity);
      put(ViewRows::depth, w, infinity);
    }
  }

  void prepare(LightTriangles& out) const {
    const RayTag f;
    std::uint32_t edge_on = 0;
    constexpr float e = 0x1p-24f;
    const auto set = [&](float x) { return hn::Set(f, x); };
    for (std::uint32_t i = 0; i < kRowLanes; i += static_cast<std::uint32_t>(hn::Lanes(f))) {
      const LaneVec3 a = offset(0, i), b = offset(1, i), c = offset(2, i);
      const LaneVec3 ab = edge(0, 1, i), bc = edge(1, 2, i), ca = edge(2, 0, i);
      // From the vertex that is nearest to the light.
      const auto a_length = length(a), b_length = length(b), c_length = length(c);
      const auto farthest = hn::Max(a_length, hn::Max(b_length, c_length));
      const auto nearest = hn::Min(a_length, hn::Min(b_length, c_length));
      const auto is_b = hn::Eq(b_length, nearest), is_c = hn::Eq(c_length, nearest);
      const auto pick = [](RayMask second, RayMask third, RayVec x, RayVec y, RayVec z) {
        return hn::IfThenElse(third, z, hn::IfThenElse(second, y, x));
      };
      // From the two shorter edges: the product of their lengths is nearest to twice the area.
      const auto ab_length = length(ab), bc_length = length(bc), ca_length = length(ca);
      const auto longest = hn::Max(hn::Max(ab_length, ca_length), bc_length);
      const auto no_bc = hn::Eq(bc_length, longest), no_ca = hn::Eq(ca_length, longest);
      const LaneVec3 first{pick(no_bc, no_ca, bc.x, ca.x, ab.x), pick(no_bc, no_ca, bc.y, ca.y, ab.y),
                           pick(no_bc, no_ca, bc.z, ca.z, ab.z)};
      const LaneVec3 second{pick(no_bc, no_ca, ca.x, ab.x, bc.x), pick(no_bc, no_ca, ca.y, ab.y, bc.y),
                            pick(no_bc, no_ca, ca.z, ab.z, bc.z)};
      const LaneVec3 normal = cross(first, second);
      const auto det = dot(
          normal, {pick(is_b, is_c, a.x, b.x, c.x), pick(is_b, is_c, a.y, b.y, c.y), pick(is_b, is_c, a.z, b.z, c.z)});
      const auto product = hn::MulAdd(pick(no_bc, no_ca, bc_length, ca_length, ab_length),
                                      pick(no_bc, no_ca, ca_length, ab_length, bc_length), set(0x1p-100f));
      const auto det_error = hn::Mul(product, hn::MulAdd(set(44 * e), nearest, set(7.2f * errors_.most)));
      const auto known = hn::Gt(hn::Abs(det), hn::Max(det_error, set(0x1p-120f)));  // so that its inverse is a float
      edge_on |= ~ray_bits(known) << i;
      const auto sign = hn::IfThenElseZero(known, hn::And(det, set(-0.0f)));
      const auto put = [&](float(&rows)[3][kRowLanes], const LaneVec3& x) {
        hn::Store(hn::Xor(x.x, sign), f, rows[0] + i);
        hn::Store(hn::Xor(x.y, sign), f, rows[1] + i);
        hn::Store(hn::Xor(x.z, sign), f, rows[2] + i);
      };
      put(out.edge[0], cross(a, ab));
      put(out.edge[1], cross(b, bc));
      put(out.edge[2], cross(c, ca));
      const auto inverse = hn::Div(set(1.0f), hn::IfThenElse(known, det, set(1.0f)));
      const auto plane = [&](std::uint32_t k, RayVec x) { hn::Store(hn::Mul(x, inverse), f, out.plane[k] + i); };
      plane(0, normal.x);
      plane(1, normal.y);
      plane(2, normal.z);
      const auto tiny = set(0x1p-100f);
      hn::Store(hn::MulAdd(hn::Mul(longest, farthest), set(32 * e + 1.8f * (errors_.start + errors_.end)), tiny), f,
                out.edge_error[0] + i);
      hn::Store(hn::Mul(longest, set(3.1f * errors_.end)), f, out.edge_error[1] + i);
      const auto ratio = hn::Mul(product, hn::Abs(inverse));
      hn::Store(hn::Mul(ratio, set(24 * e + 1.8f * errors_.start)), f, out.plane_error[0] + i);
      hn::Store(hn::MulAdd(ratio, hn::Mul(set(14 * e), nearest), set(8 * e)), f, out.plane_error[1] + i);
    }
    out.id = rows_.id;
    out.edge_on = edge_on;
  }

 private:
  RayVec row(std::uint32_t vertex, std::uint32_t axis, std::uint32_t i) const {
    return hn::Load(RayTag(), rows_.v[vertex][axis] + i);
  }
  RayVec offset(std::uint32_t vertex, std::uint32_t axis, std::uint32_t i) const {
    return hn::Sub(hn::Sub(row(vertex, axis, i), hn::Set(RayTag(), light_.high[axis])),
                   hn::Set(RayTag(), light_.low[axis]));
  }
  LaneVec3 offset(std::uint32_t vertex, std::uint32_t i) const {
    return {offset(vertex, face_.u_axis(), i), offset(vertex, face_.v_axis(), i),
            hn::Mul(offset(vertex, face_.axis, i), hn::Set(RayTag(), face_.sign))};
  }
  LaneVec3 edge(std::uint32_t from, std::uint32_t to, std::uint32_t i) const {
    const auto along = [&](std::uint32_t axis) { return hn::Sub(row(to, axis, i), row(from, axis, i)); };
    return {along(face_.u_axis()), along(face_.v_axis()), hn::Mul(along(face_.axis), hn::Set(RayTag(), face_.sign))};
  }

  const TriangleRows& rows_;
  const Face& face_;
  const LightPoint& light_;
  const ViewErrors& errors_;
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
