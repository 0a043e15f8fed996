// SPDX-License-Identifier: Apache-2.0
// Rays from one point as places in a picture, that of the cube's face on which their middle is: which of them pass a
// rectangle is looked up by its sides. Small triangles pass between most rays.

#if defined(UMBRIX_KERNELS_RAY_RASTER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_RAY_RASTER_INL_H_
#undef UMBRIX_KERNELS_RAY_RASTER_INL_H_
#else
#define UMBRIX_KERNELS_RAY_RASTER_INL_H_
#endif

#include <hwy/highway.h>

#include <cmath>
#include <limits>

#include "kernels/ray_lanes-inl.h"
#include "kernels/shaft.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

using RayInts = hn::Vec<RayBitsTag>;

/// One side of the picture, in columns: rays are in 1 to 15.
class RasterAxis {
 public:
  HWY_INLINE void set(const float (&places)[kRowLanes], float low, float high) {
    const RayTag f;
    const RayBitsTag n;
    low_ = low;
    scale_ = 14.0f / std::max(high - low, 0x1p-16f);
    alignas(64) std::int32_t columns[kRowLanes];
    for (std::uint32_t i = 0; i < kRowLanes; i += static_cast<std::uint32_t>(hn::Lanes(f)))
      hn::Store(column(hn::Load(f, places + i), 1.0f, 15.0f), n, columns + i);
    for (std::uint32_t i = 0; i < kRowLanes; i += static_cast<std::uint32_t>(hn::Lanes(f))) {
      const auto here = hn::Add(hn::Iota(n, 0), hn::Set(n, static_cast<std::int32_t>(i)));
      auto rays = hn::Zero(n);
      for (std::uint32_t ray = 0; ray < kRowLanes; ++ray)
        rays = hn::Or(rays, hn::IfThenZeroElse(hn::Gt(hn::Set(n, columns[ray]), here), hn::Set(n, 1 << ray)));
      hn::Store(rays, n, up_to_ + i);
    }
  }

  /// Rays between two places.
  HWY_INLINE RayInts between(RayVec low, RayVec high) const {
    const RayBitsTag n;
    // For places up to 8, of rays (up to 4) and of triangles, four roundings each; what is farther is beyond all rays.
    const auto margin = hn::Set(RayTag(), 0x1p-18f);
    const auto before = hn::Sub(column(hn::Sub(low, margin), 1.0f, 16.0f), hn::Set(n, 1));
    return hn::AndNot(look_up(before), look_up(column(hn::Add(high, margin), 0.0f, 15.0f)));
  }

 private:
  /// The nearest integer, by its bits in a float.
  HWY_INLINE RayInts column(RayVec place, float least, float most) const {
    const RayTag f;
    const auto x = hn::MulAdd(hn::Sub(place, hn::Set(f, low_)), hn::Set(f, scale_), hn::Set(f, 1.0f));
    const auto within = hn::Max(hn::Min(x, hn::Set(f, most)), hn::Set(f, least));
    return hn::And(hn::BitCast(RayBitsTag(), hn::Add(within, hn::Set(f, 0x1p23f))), hn::Set(RayBitsTag(), 31));
  }
  HWY_INLINE RayInts look_up(RayInts columns) const {
    const RayBitsTag n;
#if HWY_TARGET <= HWY_AVX3
    return hn::TableLookupLanes(hn::Load(n, up_to_), hn::IndicesFromVec(n, columns));
#else
    return hn::GatherIndex(n, up_to_, columns);
#endif
  }

  float low_, scale_;
  alignas(64) std::int32_t up_to_[kRowLanes];  ///< rays by the last column that they may be in
};

class RayRaster {
 public:
  /// `middle`: of the rays' ends, from their start.
  HWY_INLINE RayRaster(const RayBundle& b, const float (&middle)[3]) {
    const RayTag f;
    const float x = std::abs(middle[0]), y = std::abs(middle[1]), z = std::abs(middle[2]);
    axes_[0] = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    axes_[1] = (axes_[0] + 1) % 3;
    axes_[2] = (axes_[0] + 2) % 3;
    sign_ = middle[axes_[0]] < 0 ? -1.0f : 1.0f;
    alignas(64) float places[2][kRowLanes];
    const auto infinity = hn::Set(f, std::numeric_limits<float>::infinity());
    RayVec low[2] = {infinity, infinity}, high[2] = {hn::Neg(infinity), hn::Neg(infinity)};
    auto ahead = infinity, deepest = hn::Zero(f);
    for (std::uint32_t i = 0; i < kRowLanes; i += static_cast<std::uint32_t>(hn::Lanes(f))) {
      const auto depth = hn::Mul(hn::Load(f, b.far[axes_[0]] + i), hn::Set(f, sign_));
      const auto w = hn::Div(hn::Set(f, 1.0f), depth);
      deepest = hn::Max(deepest, depth);
      for (std::uint32_t side = 0; side < 2; ++side) {
        const auto place = hn::Mul(hn::Load(f, b.far[axes_[1 + side]] + i), w);
        hn::Store(place, f, places[side] + i);
        low[side] = hn::Min(low[side], place);
        high[side] = hn::Max(high[side], place);
        ahead = hn::Min(ahead, hn::MulSub(depth, hn::Set(f, 4.0f), hn::Abs(hn::Load(f, b.far[axes_[1 + side]] + i))));
      }
    }
    is_used_ = hn::AllTrue(f, hn::Gt(ahead, hn::Zero(f)));
    if (!is_used_) return;
    deepest_ = hn::GetLane(hn::MaxOfLanes(f, deepest)) * (1 + 0x1p-20f);
    for (std::uint32_t side = 0; side < 2; ++side)
      sides_[side].set(places[side], hn::GetLane(hn::MinOfLanes(f, low[side])),
                       hn::GetLane(hn::MaxOfLanes(f, high[side])));
  }

  /// The picture's depth, and its sides.
  std::uint32_t axis(std::uint32_t k) const { return axes_[k]; }

  /// Rays that pass the rectangles of triangles, whose vertices are given as offsets from the start on these axes.
  HWY_INLINE RayInts passing(const RayVec (&offset)[3][3]) const {
    const RayTag f;
    const RayBitsTag n;
    if (!is_used_) return hn::Set(n, 0xFFFF);
    RayVec low[2], high[2], nearest, farthest;
    for (std::uint32_t vertex = 0; vertex < 3; ++vertex) {
      const auto depth = hn::Mul(offset[vertex][0], hn::Set(f, sign_));
      const auto w = hn::Div(hn::Set(f, 1.0f), depth);
      nearest = vertex == 0 ? depth : hn::Min(nearest, depth);
      farthest = vertex == 0 ? depth : hn::Max(farthest, depth);
      for (std::uint32_t side = 0; side < 2; ++side) {
        const auto place = hn::Mul(offset[vertex][1 + side], w);
        low[side] = vertex == 0 ? place : hn::Min(low[side], place);
        high[side] = vertex == 0 ? place : hn::Max(high[side], place);
      }
    }
    return between(nearest, farthest, low, high);
  }

  /// The same for boxes.
  HWY_INLINE RayInts passing_boxes(const RayVec (&lower)[3], const RayVec (&upper)[3]) const {
    const RayTag f;
    if (!is_used_) return hn::Set(RayBitsTag(), 0xFFFF);
    const auto nearest = sign_ > 0 ? lower[0] : hn::Neg(upper[0]);
    const auto farthest = sign_ > 0 ? upper[0] : hn::Neg(lower[0]);
    const auto near_w = hn::Div(hn::Set(f, 1.0f), nearest), far_w = hn::Div(hn::Set(f, 1.0f), farthest);
    RayVec low[2], high[2];
    for (std::uint32_t side = 0; side < 2; ++side) {
      const auto least = lower[1 + side], most = upper[1 + side];
      low[side] = hn::Min(hn::Mul(least, near_w), hn::Mul(least, far_w));
      high[side] = hn::Max(hn::Mul(most, near_w), hn::Mul(most, far_w));
    }
    return between(nearest, farthest, low, high);
  }

 private:
  /// What is not all ahead has no rectangle; what is all behind is not met, nor what is all beyond the rays' ends.
  HWY_INLINE RayInts between(RayVec nearest, RayVec farthest, const RayVec (&low)[2], const RayVec (&high)[2]) const {
    const RayTag f;
    const RayBitsTag n;
    const auto rays = hn::And(sides_[0].between(low[0], high[0]), sides_[1].between(low[1], high[1]));
    const auto is_ahead = hn::Gt(nearest, hn::Set(f, 0x1p-60f));
    const auto is_out = hn::Or(hn::Lt(farthest, hn::Zero(f)), hn::Gt(nearest, hn::Set(f, deepest_)));
    return hn::IfThenZeroElse(hn::RebindMask(n, is_out),
                              hn::IfThenElse(hn::RebindMask(n, is_ahead), rays, hn::Set(n, 0xFFFF)));
  }

  std::uint32_t axes_[3];
  float sign_, deepest_ = 0;
  bool is_used_;
  RasterAxis sides_[2];
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
