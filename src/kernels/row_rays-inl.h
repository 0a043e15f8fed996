// SPDX-License-Identifier: Apache-2.0
// Some rays from one start against a row of triangles: the test and the bounds of leaf_test-inl.h, but what does not
// depend on a ray's direction d is found once. With s from the first vertex to the start, e and f the edges from there,
//   det = d . (f x e),  U = d . (f x s),  V = d . (s x e),  T = f . (s x e).
// Each is the same sum of six products, of factors that are rounded as often, so that its errors have the same bounds.

#if defined(UMBRIX_KERNELS_ROW_RAYS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_ROW_RAYS_INL_H_
#undef UMBRIX_KERNELS_ROW_RAYS_INL_H_
#else
#define UMBRIX_KERNELS_ROW_RAYS_INL_H_
#endif

#include <hwy/highway.h>

#include "kernels/lane_vectors-inl.h"
#include "kernels/leaf_test-inl.h"
#include "kernels/ray_lanes-inl.h"
#include "kernels/shaft_packets-inl.h"
#include "kernels/walk_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

/// Sixteen triangles as a start sees them.
class RowRays {
 public:
  /// None of the first vertices is farther than `reach` from the start.
  RowRays(const WalkRays& rays, const TriangleRows& rows, float reach)
      : rays_(rays),
        rows_(rows),
        edges_(kNormBound * rows.edge_bound * (2 * reach + rows.edge_bound)),
        square_(kNormBound * rows.edge_bound * rows.edge_bound),
        square_reach_(square_ * reach + kTinyTime) {}

  /// Which of some rays surely hit one of the triangles; of the others, which may.
  HWY_INLINE RayHits meet(std::uint32_t lanes) const {
    RayHits result;
    for (std::uint32_t i = 0; i < kRowLanes; i += static_cast<std::uint32_t>(hn::Lanes(RayTag()))) {
      const Seen seen = see(i);
      for (std::uint32_t rest = lanes & ~result.hit; rest != 0; rest &= rest - 1) meet(seen, lane_of(rest), result);
    }
    result.unsure &= ~result.hit;
    return result;
  }

 private:
  struct Seen {
    LaneVectors<RayTag> det, u, v;
    RayVec t;
  };

  HWY_INLINE Seen see(std::uint32_t i) const {
    const RayTag f;
    const LaneTriangles<RayTag> t = load_triangles(f, rows_, i);
    const LaneVectors<RayTag> start{hn::Set(f, rays_.start(0)), hn::Set(f, rays_.start(1)), hn::Set(f, rays_.start(2))};
    const LaneVectors<RayTag> s = minus(start, t.v0), v = cross(s, t.e1);
    return {cross(t.e2, t.e1), cross(t.e2, s), v, dot(t.e2, v)};
  }

  /// Without a branch: whether a ray that meets the row's box meets a triangle is hard to foresee.
  HWY_INLINE void meet(const Seen& seen, std::uint32_t ray, RayHits& result) const {
    const RayTag f;
    const LaneVectors<RayTag> d{hn::Set(f, rays_.direction(0, ray)), hn::Set(f, rays_.direction(1, ray)),
                                hn::Set(f, rays_.direction(2, ray))};
    const auto signed_det = dot(d, seen.det);
    const auto sign = hn::And(signed_det, hn::Set(f, -0.0f));
    const auto det = hn::Abs(signed_det), u = hn::Xor(dot(d, seen.u), sign), v = hn::Xor(dot(d, seen.v), sign);
    const auto smallest = hn::Min(hn::Min(u, v), hn::Sub(hn::Sub(det, u), v));
    const auto error = hn::MulAdd(hn::Set(f, rays_.length(ray)), hn::Set(f, edges_), hn::Set(f, kTinyEdge));
    const auto open = hn::Ge(smallest, hn::Mul(hn::Set(f, kMissFactor), error));
    const auto t = hn::Xor(seen.t, sign), square = hn::Set(f, square_), square_reach = hn::Set(f, square_reach_);
    const auto start_error = hn::MulAdd(hn::Set(f, rays_.start_reach(ray)), square, square_reach);
    const auto end_error = hn::MulAdd(hn::Set(f, rays_.end_reach(ray)), square, square_reach);
    const auto after_start = hn::Sub(t, hn::Mul(hn::Set(f, rays_.tmin(ray)), det));
    const auto before_end = hn::Sub(hn::Mul(hn::Set(f, rays_.tmax(ray)), det), t);
    const TimedLanes<RayTag> timed =
        time_lanes(f, smallest, det, after_start, before_end, error, start_error, end_error);
    result.hit |= (hn::AllFalse(f, timed.hit) ? 0u : 1u) << ray;
    result.unsure |= (hn::AllFalse(f, hn::AndNot(timed.missed, open)) ? 0u : 1u) << ray;
  }

  const WalkRays& rays_;
  const TriangleRows& rows_;
  float edges_, square_, square_reach_;
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
