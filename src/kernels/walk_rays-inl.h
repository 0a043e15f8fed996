// SPDX-License-Identifier: Apache-2.0
// A bundle's rays as walk-inl.h prepares single ones, side by side.

#if defined(UMBRIX_KERNELS_WALK_RAYS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_WALK_RAYS_INL_H_
#undef UMBRIX_KERNELS_WALK_RAYS_INL_H_
#else
#define UMBRIX_KERNELS_WALK_RAYS_INL_H_
#endif

#include <hwy/highway.h>

#include "kernels/ray_lanes-inl.h"
#include "kernels/scene_view.h"
#include "kernels/shaft.h"
#include "kernels/walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

class WalkRays {
 public:
  /// Of some of `rays`, in the default mode of floats: denormals count. False if they start far off (see far_ray.h).
  bool prepare(const RaySpan& rays, const RayBundle& bundle, const Tree& tree) {
    const RayTag f;
    start_ = bundle.start;
    if (!is_near(tree)) return false;
    const auto scale = hn::Set(f, power_of_two(tree.scale_exponent));
    for (std::uint32_t i = 0; i < bundle.count; i += static_cast<std::uint32_t>(hn::Lanes(f)))
      put(load_rays(rays, bundle.first + i), scale, i);
    return true;
  }

  /// For what a single ray meets; its inverse and its time scale are not set.
  HWY_INLINE WalkRay ray(std::uint32_t i) const {
    WalkRay result;
    for (std::uint32_t k = 0; k < 3; ++k) {
      result.origin[k] = start_[k];
      result.direction[k] = direction_[k][i];
    }
    result.tmin = tmin_[i];
    result.tmax = tmax_[i];
    result.length = length_[i];
    return result;
  }

  float start(std::uint32_t axis) const { return start_[axis]; }
  const float& direction(std::uint32_t axis, std::uint32_t i) const { return direction_[axis][i]; }
  const float& tmin(std::uint32_t i) const { return tmin_[i]; }
  const float& tmax(std::uint32_t i) const { return tmax_[i]; }
  const float& length(std::uint32_t i) const { return length_[i]; }
  /// How far it is to where the ray begins and ends, as 1-norms.
  const float& start_reach(std::uint32_t i) const { return start_reach_[i]; }
  const float& end_reach(std::uint32_t i) const { return end_reach_[i]; }

 private:
  bool is_near(const Tree& tree) const {
    const float margin = near_margin(tree);
    bool result = true;
    for (int k = 0; k < 3; ++k)
      result &= start_[k] >= tree.root.lower[k] - margin && start_[k] <= tree.root.upper[k] + margin;
    return result;
  }

  /// Directions times the power of two that brings their largest component to [1, 2), times by the one that undoes it.
  HWY_INLINE void put(const RayFields& r, RayVec scale, std::uint32_t i) {
    const RayTag f;
    const RayBitsTag n;
    const auto largest = hn::Max(hn::Abs(r.direction[0]), hn::Max(hn::Abs(r.direction[1]), hn::Abs(r.direction[2])));
    const auto exponent = hn::And(hn::BitCast(n, largest), hn::Set(n, 0x7F800000));
    const auto power = hn::BitCast(f, exponent), inverse = hn::BitCast(f, hn::Sub(hn::Set(n, 0x7F000000), exponent));
    auto length = hn::Zero(f);
    for (std::uint32_t k = 0; k < 3; ++k) {
      const auto d = hn::Mul(r.direction[k], inverse);
      length = hn::Add(length, hn::Abs(d));
      hn::Store(d, f, direction_[k] + i);
    }
    hn::Store(length, f, length_ + i);
    const auto limit = hn::Set(f, static_cast<float>(kTimeLimit));
    const auto tmin = hn::Min(hn::Mul(hn::Mul(r.tmin, scale), power), limit);
    const auto tmax = hn::Min(hn::Mul(hn::Mul(r.tmax, scale), power), limit);
    hn::Store(tmin, f, tmin_ + i);
    hn::Store(tmax, f, tmax_ + i);
    hn::Store(hn::Mul(hn::Abs(tmin), length), f, start_reach_ + i);
    hn::Store(hn::Mul(hn::Abs(tmax), length), f, end_reach_ + i);
  }

  const float* start_ = nullptr;
  alignas(64) float direction_[3][kRowLanes], tmin_[kRowLanes], tmax_[kRowLanes], length_[kRowLanes];
  alignas(64) float start_reach_[kRowLanes], end_reach_[kRowLanes];
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
