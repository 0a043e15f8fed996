// SPDX-License-Identifier: Apache-2.0
// Rays in lanes.

#if defined(UMBRIX_KERNELS_RAY_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_RAY_LANES_INL_H_
#undef UMBRIX_KERNELS_RAY_LANES_INL_H_
#else
#define UMBRIX_KERNELS_RAY_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include <cstdint>

#include "index/triangle_bvh.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using RayTag = hn::CappedTag<float, kRowLanes>;
using RayVec = hn::Vec<RayTag>;
using RayMask = hn::Mask<RayTag>;
using RayBitsTag = hn::RebindToSigned<RayTag>;

inline std::uint32_t ray_bits(RayMask mask) {
  alignas(8) std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(RayTag(), mask, bytes);
  return static_cast<std::uint32_t>(bytes[0]) | static_cast<std::uint32_t>(bytes[1]) << 8;
}

/// The lowest lane of some.
inline std::uint32_t first_lane(std::uint32_t lanes) {
  return static_cast<std::uint32_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(lanes));
}

inline RayMask lane_mask(std::uint32_t bits) {
  const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8)};
  return hn::LoadMaskBits(RayTag(), bytes);
}

/// Calls each(i, lanes) for i = first, first + 16, ...: of the last lanes only those that are there.
template <class Each>
HWY_INLINE void for_lanes(std::size_t first, std::size_t count, Each&& each) {
  const RayTag f;
  for (std::size_t i = 0; i < count; i += hn::Lanes(f)) each(first + i, hn::FirstN(f, count - i));
}

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
