// SPDX-License-Identifier: Apache-2.0
// A ray in the space of a hierarchy's boxes, in double: there float's limits are out of reach, so that rays from far
// away need no care. Boxes grow by what the frame asks for, which is put into the ray: docs/instances.md.

#if defined(UMBRIX_KERNELS_LOCAL_RAY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_LOCAL_RAY_INL_H_
#undef UMBRIX_KERNELS_LOCAL_RAY_INL_H_
#else
#define UMBRIX_KERNELS_LOCAL_RAY_INL_H_
#endif

#include <hwy/highway.h>

#include "index/local_frame.h"
#include "kernels/bvh_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

/// A valid ray in double, which holds its floats exactly.
struct WorldRay {
  double origin[3], direction[3];
  double tmin, tmax;
  double largest_origin = 0, largest_direction = 0;
  double origin_norm = 0, direction_norm = 0;  ///< sums of magnitudes

  explicit WorldRay(const Ray& ray) : tmin(ray.tmin), tmax(ray.tmax) {
    for (int k = 0; k < 3; ++k) {
      origin[k] = ray.origin[k];
      direction[k] = ray.direction[k];
      largest_origin = std::max(largest_origin, std::abs(origin[k]));
      largest_direction = std::max(largest_direction, std::abs(direction[k]));
      origin_norm += std::abs(origin[k]);
      direction_norm += std::abs(direction[k]);
    }
  }
};

/// Its times at a frame's boxes. A hit at t lies in the interval of every box above its triangle.
class LocalRay {
 public:
  using Time = double;

  LocalRay(const WorldRay& ray, const LocalFrame& frame, double tmax) : tmin_(ray.tmin), tmax_(tmax) {
    double from[3];
    for (int j = 0; j < 3; ++j) from[j] = ray.origin[j] - frame.translation[j];
    for (int k = 0; k < 3; ++k) {
      const double(&row)[3] = frame.inverse[k];
      const double origin = row[0] * from[0] + row[1] * from[1] + row[2] * from[2];
      double slope = row[0] * ray.direction[0] + row[1] * ray.direction[1] + row[2] * ray.direction[2];
      const double least = LocalFrame::kLeastSlope * frame.norm[k] * ray.largest_direction;
      if (std::abs(slope) < least) slope = std::copysign(least, slope);
      const double growth = frame.growth[k] + LocalFrame::kOriginGrowth * frame.norm[k] * ray.largest_origin;
      down_[k] = slope < 0;
      inverse_[k] = 1 / slope;
      entry_origin_[k] = down_[k] ? origin - growth : origin + growth;
      exit_origin_[k] = down_[k] ? origin + growth : origin - growth;
    }
  }

  double start() const { return tmin_; }

  HWY_INLINE void cross(const BvhNode& node, CrossedBoxes<double, kBvhWidth>& out) const {
    cross_lanes(node.lower, node.upper, out);
  }

  /// Of boxes whose corners are the first two vertices of a leaf's triangles.
  HWY_INLINE void cross(const TriangleRows& rows, CrossedBoxes<double, kRowLanes>& out) const {
    cross_lanes(rows.v[0], rows.v[1], out);
    out.lanes &= (1u << rows.count) - 1;
  }

 private:
  template <std::uint32_t kBoxes>
  HWY_INLINE void cross_lanes(const float (&lower)[3][kBoxes], const float (&upper)[3][kBoxes],
                              CrossedBoxes<double, kBoxes>& out) const {
    const hn::CappedTag < double, kBoxes<8 ? kBoxes : 8> d;
    const hn::Rebind<float, decltype(d)> f;
    out.lanes = 0;
    for (std::uint32_t i = 0; i < kBoxes; i += static_cast<std::uint32_t>(hn::Lanes(d))) {
      auto t0 = hn::Set(d, tmin_), t1 = hn::Set(d, tmax_);
      for (std::uint32_t axis = 0; axis < 3; ++axis) {
        const auto entry = hn::PromoteTo(d, hn::Load(f, (down_[axis] ? upper : lower)[axis] + i));
        const auto exit = hn::PromoteTo(d, hn::Load(f, (down_[axis] ? lower : upper)[axis] + i));
        const auto inverse = hn::Set(d, inverse_[axis]);
        t0 = hn::Max(t0, hn::Mul(hn::Sub(entry, hn::Set(d, entry_origin_[axis])), inverse));
        t1 = hn::Min(t1, hn::Mul(hn::Sub(exit, hn::Set(d, exit_origin_[axis])), inverse));
      }
      alignas(8) std::uint8_t bits[8] = {};
      hn::StoreMaskBits(d, hn::Le(t0, t1), bits);
      out.lanes |= static_cast<std::uint32_t>(bits[0]) << i;
      hn::Store(t0, d, out.t0 + i);
    }
  }

  double entry_origin_[3], exit_origin_[3], inverse_[3];
  double tmin_, tmax_;
  bool down_[3];
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
