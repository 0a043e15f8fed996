// SPDX-License-Identifier: Apache-2.0
// Vectors of space, one a lane.

#if defined(UMBRIX_KERNELS_LANE_VECTORS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_LANE_VECTORS_INL_H_
#undef UMBRIX_KERNELS_LANE_VECTORS_INL_H_
#else
#define UMBRIX_KERNELS_LANE_VECTORS_INL_H_
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class D>
struct LaneVectors {
  hn::Vec<D> x, y, z;
};

template <class D>
HWY_INLINE LaneVectors<D> minus(const LaneVectors<D>& a, const LaneVectors<D>& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

template <class D>
HWY_INLINE LaneVectors<D> cross(const LaneVectors<D>& a, const LaneVectors<D>& b) {
  return {hn::MulSub(a.y, b.z, hn::Mul(a.z, b.y)), hn::MulSub(a.z, b.x, hn::Mul(a.x, b.z)),
          hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x))};
}

template <class D>
HWY_INLINE hn::Vec<D> dot(const LaneVectors<D>& a, const LaneVectors<D>& b) {
  return hn::MulAdd(a.z, b.z, hn::MulAdd(a.y, b.y, hn::Mul(a.x, b.x)));
}

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
