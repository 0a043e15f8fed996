// SPDX-License-Identifier: Apache-2.0
// When each of a bundle's rays is in a box.

#if defined(UMBRIX_KERNELS_BUNDLE_TIMES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_BUNDLE_TIMES_INL_H_
#undef UMBRIX_KERNELS_BUNDLE_TIMES_INL_H_
#else
#define UMBRIX_KERNELS_BUNDLE_TIMES_INL_H_
#endif

#include <hwy/highway.h>

#include "kernels/bundle_hull-inl.h"
#include "kernels/ray_lanes-inl.h"
#include "kernels/shaft.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

/// Lanes of rays, by box.
struct alignas(64) RaysByBox {
  std::uint32_t of[kRowLanes] = {};
};

/// A bundle's rays against boxes. Times are parts of the way, as in bundle_hull-inl.h.
class BundleTimes {
 public:
  void set(const RayBundle& b) {
    const RayTag f;
    for (std::uint32_t k = 0; k < 3; ++k) {
      falls_[k] = 0;
      for (std::uint32_t i = 0; i < kRowLanes; i += static_cast<std::uint32_t>(hn::Lanes(f))) {
        const auto far = hn::Load(f, b.far[k] + i), least = hn::Set(f, kLeastSlope);
        const auto slope = hn::IfThenElse(hn::Lt(hn::Abs(far), least), hn::CopySign(least, far), far);
        hn::Store(hn::Div(hn::Set(f, 1.0f), slope), f, inverse_[k] + i);
        falls_[k] |= ray_bits(hn::Lt(slope, hn::Zero(f))) << i;
      }
    }
    for (std::uint32_t i = 0; i < kRowLanes; i += static_cast<std::uint32_t>(hn::Lanes(f)))
      hn::Store(hn::Mul(hn::Load(f, b.begin + i), hn::Set(f, 1 / kLaterExit)), f, begin_ + i);
  }

  /// Each of some boxes against the rays side by side: which of the `active` rays meet it, for all boxes.
  HWY_INLINE void by_boxes(const Faces& faces, std::uint32_t boxes, std::uint32_t active, RaysByBox& rays) const {
    const RayTag f;
    rays = RaysByBox();
    for (std::uint32_t rest = boxes; rest != 0; rest &= rest - 1) {
      const std::uint32_t lane = lane_of(rest);
      std::uint32_t met = 0;
      for (std::uint32_t i = 0; i < kRowLanes; i += static_cast<std::uint32_t>(hn::Lanes(f))) {
        auto t0 = hn::Load(f, begin_ + i), t1 = hn::Set(f, 1.0f);
        for (std::uint32_t k = 0; k < 3; ++k) {
          const auto inverse = hn::Load(f, inverse_[k] + i);
          const auto a = hn::Mul(hn::Set(f, faces.at[k][lane]), inverse);
          const auto b = hn::Mul(hn::Set(f, faces.at[3 + k][lane]), inverse);
          t0 = hn::Max(t0, hn::Min(a, b));
          t1 = hn::Min(t1, hn::Max(a, b));
        }
        met |= ray_bits(hn::Le(t0, hn::Mul(t1, hn::Set(f, kLaterExit)))) << i;
      }
      rays.of[lane] = met & active;
    }
  }

  /// The same, each of the `active` rays against the boxes side by side.
  HWY_INLINE void by_rays(const Faces& faces, std::uint32_t active, RaysByBox& rays) const {
    const RayTag f;
    const hn::RebindToUnsigned<RayTag> n;
    for (std::uint32_t i = 0; i < kRowLanes; i += static_cast<std::uint32_t>(hn::Lanes(f))) {
      auto met = hn::Zero(n);
      for (std::uint32_t rest = active; rest != 0; rest &= rest - 1) {
        const std::uint32_t ray = lane_of(rest);
        auto t0 = hn::Set(f, begin_[ray]), t1 = hn::Set(f, 1.0f);
        for (std::uint32_t k = 0; k < 3; ++k) {
          const std::uint32_t falls = falls_[k] >> ray & 1;
          const auto inverse = hn::Set(f, inverse_[k][ray]);
          t0 = hn::Max(t0, hn::Mul(hn::Load(f, faces.at[k + 3 * falls] + i), inverse));
          t1 = hn::Min(t1, hn::Mul(hn::Load(f, faces.at[k + 3 - 3 * falls] + i), inverse));
        }
        const auto crosses = hn::Le(t0, hn::Mul(t1, hn::Set(f, kLaterExit)));
        met = hn::Or(met, hn::IfThenElseZero(hn::RebindMask(n, crosses), hn::Set(n, rest & (0u - rest))));
      }
      hn::Store(met, n, rays.of + i);
    }
  }

 private:
  alignas(64) float inverse_[3][kRowLanes], begin_[kRowLanes];
  std::uint32_t falls_[3];  ///< lanes, by axis
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
