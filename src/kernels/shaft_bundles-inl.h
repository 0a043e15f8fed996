// SPDX-License-Identifier: Apache-2.0
// Rays read as bundles: consecutive ones from the same point, up to sixteen.

#if defined(UMBRIX_KERNELS_SHAFT_BUNDLES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_SHAFT_BUNDLES_INL_H_
#undef UMBRIX_KERNELS_SHAFT_BUNDLES_INL_H_
#else
#define UMBRIX_KERNELS_SHAFT_BUNDLES_INL_H_
#endif

#include <hwy/highway.h>

#include "kernels/ray_class.h"
#include "kernels/ray_lanes-inl.h"
#include "kernels/shaft.h"
#include "tree/tree.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

class BundleReader {
 public:
  BundleReader(const Tree& tree, const RaySpan& rays) : rays_(rays), scale_(power_of_two(tree.scale_exponent)) {}

  /// Reads the bundle that begins with ray `first`. False if its rays are not for floats: then only `first` and `count`
  /// are set.
  HWY_INLINE bool read(std::size_t first, RayBundle& out) const {
    const RayTag f;
    const auto lanes = static_cast<std::uint32_t>(hn::Lanes(f));
    const auto most = static_cast<std::uint32_t>(std::min<std::size_t>(kRowLanes, rays_.count - first));
    const Ray& ray = rays_[first];
    prefetch_rays(rays_, first + kAhead, kRowLanes);
    std::uint32_t same = 0, good = 0, begins = 0;
    for (std::uint32_t i = 0; i < most; i += lanes) {
      const RayFields r = load_rays(rays_, first + i);
      const auto scaled = hn::Mul(r.tmax, hn::Set(f, scale_));
      const auto zero = hn::Zero(f);
      auto direction = zero, sum = zero;
      auto is_same = hn::Eq(r.origin[0], hn::Set(f, ray.origin[0]));
      for (std::size_t k = 0; k < 3; ++k) {
        if (k > 0) is_same = hn::And(is_same, hn::Eq(r.origin[k], hn::Set(f, ray.origin[k])));
        const auto far = hn::Mul(r.direction[k], scaled);
        hn::Store(far, f, out.far[k] + i);
        sum = hn::Add(sum, hn::Abs(far));
        direction = hn::Max(direction, hn::Abs(r.direction[k]));
      }
      // Comparisons with NaN fail; a maximum may lose one, but the sum is one then.
      auto is_good = hn::And(hn::Gt(sum, hn::Set(f, kLeastLength)), hn::Lt(sum, hn::Set(f, kMostLength)));
      is_good =
          hn::And(is_good, hn::And(hn::Gt(direction, hn::Set(f, 0x1p-90f)), hn::Lt(direction, hn::Set(f, 0x1p30f))));
      is_good = hn::And(is_good, hn::And(hn::Ge(r.tmin, zero), hn::Lt(r.tmin, r.tmax)));
      same |= ray_bits(is_same) << i;
      good |= ray_bits(is_good) << i;
      const auto begins_later = hn::Gt(r.tmin, zero);
      begins |= ray_bits(begins_later) << i;
      hn::Store(HWY_LIKELY(hn::AllFalse(f, begins_later)) ? zero : hn::Div(r.tmin, r.tmax), f, out.begin + i);
    }
    out.first = static_cast<std::uint32_t>(first);
    out.count = std::max(1u, std::min(most, count_ones(same)));
    const std::uint32_t present = (1u << out.count) - 1;
    out.has_begin = (begins & present) != 0;
    float reach = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      out.start[k] = ray.origin[k] * scale_;
      reach += std::abs(out.start[k]);
    }
    for (std::uint32_t i = out.count; i < kRowLanes; ++i) repeat_first(i, out);
    bound(out);
    return (~good & present) == 0 && reach < kMostLength;
  }

 private:
  /// So many rays ahead are fetched.
  static constexpr std::size_t kAhead = 512;

  /// Within these, what denormals may lose is too small to matter.
  static constexpr float kLeastLength = 0x1p-30f, kMostLength = 0x1p20f;

  static std::uint32_t count_ones(std::uint32_t bits) { return first_lane(~bits | 1u << kRowLanes); }

  static void repeat_first(std::uint32_t lane, RayBundle& out) {
    for (auto& far : out.far) far[lane] = far[0];
    out.begin[lane] = out.begin[0];
  }

  static HWY_INLINE void bound(RayBundle& out) {
    const RayTag f;
    RayVec least[3], most[3];
    for (std::uint32_t k = 0; k < 3; ++k) {
      least[k] = hn::Load(f, out.far[k]);
      most[k] = hn::Neg(least[k]);
      for (std::uint32_t i = static_cast<std::uint32_t>(hn::Lanes(f)); i < kRowLanes;
           i += static_cast<std::uint32_t>(hn::Lanes(f))) {
        const auto far = hn::Load(f, out.far[k] + i);
        least[k] = hn::Min(least[k], far);
        most[k] = hn::Min(most[k], hn::Neg(far));
      }
    }
    const FourLeast low(least[0], least[1], least[2], least[2]), minus_high(most[0], most[1], most[2], most[2]);
    for (std::uint32_t k = 0; k < 4; ++k) {
      out.low[k] = low.of[k];
      out.high[k] = -minus_high.of[k];
    }
  }

  const RaySpan& rays_;
  float scale_;
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
