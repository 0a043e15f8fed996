// SPDX-License-Identifier: Apache-2.0
// Sixteen bundles in a row are cut into shafts: where their starts are far apart compared with their ends, as across
// the edge of a thing, in the middle of the starts' longest side.

#if defined(UMBRIX_KERNELS_SHAFT_CUT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_SHAFT_CUT_INL_H_
#undef UMBRIX_KERNELS_SHAFT_CUT_INL_H_
#else
#define UMBRIX_KERNELS_SHAFT_CUT_INL_H_
#endif

#include <hwy/highway.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "core/math.h"
#include "kernels/ray_lanes-inl.h"
#include "kernels/shaft.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

class ShaftCutter {
 public:
  /// `alone` takes the numbers of bundles whose rays go all ways: these have no shaft.
  ShaftCutter(const std::vector<RayBundle>& bundles, std::vector<Shaft>& shafts, std::vector<std::uint32_t>& alone)
      : bundles_(bundles), shafts_(shafts), alone_(alone) {}

  /// Cuts the bundles of a row, of which there are `count`.
  void cut_row(std::uint32_t row, std::uint32_t count) {
    row_ = row;
    for (std::uint32_t lane = 0; lane < kRowLanes; ++lane) {
      const RayBundle& b = bundle(lane < count ? lane : 0);
      for (std::uint32_t k = 0; k < 3; ++k) {
        starts_[k][lane] = b.start[k];
        ends_low_[k][lane] = b.start[k] + b.low[k];
        ends_high_[k][lane] = b.start[k] + b.high[k];
      }
    }
    cut((1u << count) - 1);
  }

 private:
  const RayBundle& bundle(std::uint32_t lane) const { return bundles_[row_ * kRowLanes + lane]; }

  void cut(std::uint32_t lanes) {
    Shaft s;
    s.row = row_;
    s.lanes = lanes;
    bound(s);
    std::uint32_t axis = 0;
    float widest = 0, ends = 0, length = 0, farthest = 0;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const float width = s.start_high[k] - s.start_low[k];
      if (width > widest) {
        widest = width;
        axis = k;
      }
      ends = std::max(ends, s.end_high[k] - s.end_low[k]);
      length += std::abs(s.end_low[k] - s.start_low[k]);
      farthest = std::max(farthest, std::abs(0.5f * (s.end_low[k] + s.end_high[k]) - s.middle[k]));
    }
    if (widest > kWidth * ends + kSlope * length) {
      const std::uint32_t low = below(axis, 0.5f * (s.start_low[axis] + s.start_high[axis])) & lanes;
      if (low != 0 && low != lanes) {
        cut(low);
        cut(lanes & ~low);
        return;
      }
    }
    if (ends > kWide * farthest) {
      for (std::uint32_t rest = lanes; rest != 0; rest &= rest - 1)
        alone_.push_back(row_ * kRowLanes + first_lane(rest));
      return;
    }
    find_plane(s);
    shafts_.push_back(s);
  }

  void bound(Shaft& s) const {
    const std::uint32_t lanes = s.lanes;
    const FourLeast a(least(starts_[0], lanes), least(starts_[1], lanes), least(starts_[2], lanes),
                      least(ends_low_[0], lanes));
    const FourLeast b(least(ends_low_[1], lanes), least(ends_low_[2], lanes), least_negative(starts_[0], lanes),
                      least_negative(starts_[1], lanes));
    const FourLeast c(least_negative(starts_[2], lanes), least_negative(ends_high_[0], lanes),
                      least_negative(ends_high_[1], lanes), least_negative(ends_high_[2], lanes));
    const float low[6] = {a.of[0], a.of[1], a.of[2], a.of[3], b.of[0], b.of[1]};
    const float high[6] = {-b.of[2], -b.of[3], -c.of[0], -c.of[1], -c.of[2], -c.of[3]};
    s.largest = 1;
    for (std::uint32_t k = 0; k < 3; ++k) {
      s.start_low[k] = low[k];
      s.start_high[k] = high[k];
      s.end_low[k] = low[3 + k];
      s.end_high[k] = high[3 + k];
      s.middle[k] = 0.5f * (s.start_low[k] + s.start_high[k]);
      s.largest = std::max({s.largest, -s.start_low[k], s.start_high[k], -s.end_low[k], s.end_high[k]});
    }
  }

  /// The least of some lanes, somewhere in a vector; or the least of their negatives.
  static HWY_INLINE RayVec least(const float (&row)[kRowLanes], std::uint32_t lanes) {
    return least_of(row, lanes, [](RayVec x) { return x; });
  }
  static HWY_INLINE RayVec least_negative(const float (&row)[kRowLanes], std::uint32_t lanes) {
    return least_of(row, lanes, [](RayVec x) { return hn::Neg(x); });
  }
  template <class Value>
  static HWY_INLINE RayVec least_of(const float (&row)[kRowLanes], std::uint32_t lanes, Value&& value) {
    const RayTag f;
    const auto infinity = hn::Set(f, std::numeric_limits<float>::infinity());
    auto result = infinity;
    for (std::uint32_t i = 0; i < kRowLanes; i += static_cast<std::uint32_t>(hn::Lanes(f)))
      result = hn::Min(result, hn::IfThenElse(lane_mask(lanes >> i), value(hn::Load(f, row + i)), infinity));
    return result;
  }

  /// Of the row's starts, those below x on an axis.
  std::uint32_t below(std::uint32_t axis, float x) const {
    const RayTag f;
    std::uint32_t result = 0;
    for (std::uint32_t i = 0; i < kRowLanes; i += static_cast<std::uint32_t>(hn::Lanes(f)))
      result |= ray_bits(hn::Lt(hn::Load(f, starts_[axis] + i), hn::Set(f, x))) << i;
    return result;
  }

  /// A plane through three starts that are far apart, below all starts and ends; towards the ends if there is none.
  void find_plane(Shaft& s) const {
    const auto start = [&](std::uint32_t lane) {
      return Vec3(starts_[0][lane] - s.middle[0], starts_[1][lane] - s.middle[1], starts_[2][lane] - s.middle[2]);
    };
    const auto along = [&](std::uint32_t k, float from, std::uint32_t i) {
      return hn::Sub(hn::Load(RayTag(), starts_[k] + i), hn::Set(RayTag(), from));
    };
    const std::uint32_t first = first_lane(s.lanes);
    const float from[3] = {starts_[0][first], starts_[1][first], starts_[2][first]};
    const Vec3 side = start(lane_of_most(s.lanes,
                                         [&](std::uint32_t i) {
                                           const auto x = along(0, from[0], i), y = along(1, from[1], i),
                                                      z = along(2, from[2], i);
                                           return square(x, y, z);
                                         })) -
                      start(first);
    const std::uint32_t third = lane_of_most(s.lanes, [&](std::uint32_t i) {
      const RayTag f;
      const auto x = along(0, from[0], i), y = along(1, from[1], i), z = along(2, from[2], i);
      const auto a = hn::Set(f, side.x), b = hn::Set(f, side.y), c = hn::Set(f, side.z);
      return square(hn::MulSub(b, z, hn::Mul(c, y)), hn::MulSub(c, x, hn::Mul(a, z)), hn::MulSub(a, y, hn::Mul(b, x)));
    });
    Vec3 to_end, normal = glm::cross(side, start(third) - start(first));
    for (int k = 0; k < 3; ++k) to_end[k] = 0.5f * (s.end_low[k] + s.end_high[k]) - s.middle[k];
    const auto sum = [](const Vec3& x) { return std::abs(x.x) + std::abs(x.y) + std::abs(x.z); };
    if (!(sum(normal) > 0x1p-80f)) normal = to_end;
    if (!(sum(normal) > 0x1p-80f)) normal = Vec3(1, 0, 0);
    normal *= (glm::dot(normal, to_end) < 0 ? -1.0f : 1.0f) / sum(normal);

    const RayTag f;
    const auto infinity = hn::Set(f, std::numeric_limits<float>::infinity());
    auto least = infinity;
    for (std::uint32_t i = 0; i < kRowLanes; i += static_cast<std::uint32_t>(hn::Lanes(f))) {
      auto height = hn::Zero(f);
      for (std::uint32_t k = 0; k < 3; ++k)
        height = hn::MulAdd(hn::Set(f, normal[static_cast<int>(k)]), along(k, s.middle[k], i), height);
      least = hn::Min(least, hn::IfThenElse(lane_mask(s.lanes >> i), height, infinity));
    }
    float ends = -0x1p-20f * s.largest;
    for (int k = 0; k < 3; ++k)
      ends += std::min(normal[k] * (s.end_low[k] - s.middle[k]), normal[k] * (s.end_high[k] - s.middle[k]));
    s.base = std::min(hn::GetLane(hn::MinOfLanes(f, least)), ends);
    for (int k = 0; k < 3; ++k) s.normal[k] = normal[k];
  }

  static HWY_INLINE RayVec square(RayVec x, RayVec y, RayVec z) {
    return hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)));
  }

  /// Of some lanes, the one for which value(i), of lanes from i on, is largest.
  template <class Value>
  static HWY_INLINE std::uint32_t lane_of_most(std::uint32_t lanes, Value&& value) {
    const RayTag f;
    alignas(64) float values[kRowLanes];
    const auto none = hn::Set(f, -1.0f);
    auto most = none;
    for (std::uint32_t i = 0; i < kRowLanes; i += static_cast<std::uint32_t>(hn::Lanes(f))) {
      const auto x = hn::IfThenElse(lane_mask(lanes >> i), value(i), none);
      hn::Store(x, f, values + i);
      most = hn::Max(most, x);
    }
    const auto largest = hn::Set(f, hn::GetLane(hn::MaxOfLanes(f, most)));
    std::uint32_t found = 0;
    for (std::uint32_t i = 0; i < kRowLanes; i += static_cast<std::uint32_t>(hn::Lanes(f)))
      found |= ray_bits(hn::Eq(hn::Load(f, values + i), largest)) << i;
    return first_lane((found & lanes) != 0 ? found & lanes : lanes);
  }

  /// How wide the starts of a shaft may be, compared with its ends and with its length.
  static constexpr float kWidth = 0.45f, kSlope = 0.01f;

  /// Ends that are wider than this, compared with their distance, are seen all around.
  static constexpr float kWide = 0.8f;

  const std::vector<RayBundle>& bundles_;
  std::vector<Shaft>& shafts_;
  std::vector<std::uint32_t>& alone_;
  std::uint32_t row_ = 0;
  alignas(64) float starts_[3][kRowLanes], ends_low_[3][kRowLanes], ends_high_[3][kRowLanes];
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
