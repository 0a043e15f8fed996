// SPDX-License-Identifier: Apache-2.0
// The hull of a bundle's rays: on each axis they lie between two lines over the time from start to ends. It meets a box
// if there is a time at which the box in between does. A time is a difference over a length, each of them, the quotient
// and the length's inverse rounded once; that of an exit is made later by more than two such errors.

#if defined(UMBRIX_KERNELS_BUNDLE_HULL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_BUNDLE_HULL_INL_H_
#undef UMBRIX_KERNELS_BUNDLE_HULL_INL_H_
#else
#define UMBRIX_KERNELS_BUNDLE_HULL_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "kernels/ray_lanes-inl.h"
#include "kernels/shaft.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

/// What makes the time of an exit certainly late enough.
inline constexpr float kLaterExit = 1 + 0x1p-20f;

/// What covers the rounding of a sum of three distances.
inline constexpr float kMoreReach = 1 + 0x1p-20f;

/// Nothing moves faster through the planes of an axis: the time at one is beyond all others then, and a ray moves by
/// less than any box is grown.
inline constexpr float kLeastSlope = 0x1p-64f;

/// Sixteen boxes as offsets from a start: lower, then upper faces.
struct alignas(64) Faces {
  float at[6][kRowLanes];
  float reach[kRowLanes];  ///< no point of a box is farther from the start, as a 1-norm
};

class BundleHull {
 public:
  explicit BundleHull(const RayBundle& b) : start_(b.start) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      inverse_low_[k] = inverse(b.low[k]);
      inverse_high_[k] = inverse(b.high[k]);
    }
  }

  /// Fills `faces`.
  HWY_INLINE void see(const float (&lower)[3][kRowLanes], const float (&upper)[3][kRowLanes], Faces& faces) const {
    const RayTag f;
    for (std::uint32_t i = 0; i < kRowLanes; i += static_cast<std::uint32_t>(hn::Lanes(f))) {
      auto reach = hn::Zero(f);
      for (std::uint32_t k = 0; k < 3; ++k) {
        const auto [low_face, high_face] = see(lower[k] + i, upper[k] + i, k, i, faces);
        reach = hn::Add(reach, hn::Max(hn::Neg(low_face), high_face));
      }
      hn::Store(hn::Mul(reach, hn::Set(f, kMoreReach)), f, faces.reach + i);
    }
  }

  /// Which of sixteen boxes it meets; fills `faces`.
  HWY_INLINE std::uint32_t meets(const float (&lower)[3][kRowLanes], const float (&upper)[3][kRowLanes],
                                 Faces& faces) const {
    const RayTag f;
    std::uint32_t result = 0;
    for (std::uint32_t i = 0; i < kRowLanes; i += static_cast<std::uint32_t>(hn::Lanes(f))) {
      auto t0 = hn::Zero(f), t1 = hn::Set(f, 1.0f), reach = hn::Zero(f);
      for (std::uint32_t k = 0; k < 3; ++k) {
        const auto [low_face, high_face] = see(lower[k] + i, upper[k] + i, k, i, faces);
        reach = hn::Add(reach, hn::Max(hn::Neg(low_face), high_face));
        const auto low = hn::Mul(high_face, hn::Set(f, inverse_low_[k]));
        const auto high = hn::Mul(low_face, hn::Set(f, inverse_high_[k]));
        if (inverse_low_[k] > 0)
          t1 = hn::Min(t1, low);
        else
          t0 = hn::Max(t0, low);
        if (inverse_high_[k] > 0)
          t0 = hn::Max(t0, high);
        else
          t1 = hn::Min(t1, high);
      }
      hn::Store(hn::Mul(reach, hn::Set(f, kMoreReach)), f, faces.reach + i);
      result |= ray_bits(hn::Le(t0, hn::Mul(t1, hn::Set(f, kLaterExit)))) << i;
    }
    return result;
  }

 private:
  struct FacePair {
    RayVec low, high;
  };

  HWY_INLINE FacePair see(const float* lower, const float* upper, std::uint32_t axis, std::uint32_t i,
                          Faces& faces) const {
    const RayTag f;
    const auto start = hn::Set(f, start_[axis]);
    const FacePair pair{hn::Sub(hn::Load(f, lower), start), hn::Sub(hn::Load(f, upper), start)};
    hn::Store(pair.low, f, faces.at[axis] + i);
    hn::Store(pair.high, f, faces.at[3 + axis] + i);
    return pair;
  }

  static float inverse(float x) { return 1 / (std::abs(x) < kLeastSlope ? std::copysign(kLeastSlope, x) : x); }

  const float (&start_)[3];
  float inverse_low_[3], inverse_high_[3];
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
