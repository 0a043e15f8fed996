// SPDX-License-Identifier: Apache-2.0
// Rays in lanes.

#if defined(UMBRIX_KERNELS_RAY_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_RAY_LANES_INL_H_
#undef UMBRIX_KERNELS_RAY_LANES_INL_H_
#else
#define UMBRIX_KERNELS_RAY_LANES_INL_H_
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "index/triangle_bvh.h"
#include "umbrix/ray.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using RayTag = hn::CappedTag<float, kRowLanes>;
using RayVec = hn::Vec<RayTag>;
using RayMask = hn::Mask<RayTag>;
using RayBitsTag = hn::RebindToSigned<RayTag>;

/// The lanes of a mask, of as many as Bits has at most.
template <class Bits, class Tag>
HWY_INLINE Bits mask_bits(Tag tag, hn::Mask<Tag> mask) {
  alignas(8) std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(tag, mask, bytes);
#if HWY_IS_LITTLE_ENDIAN
  Bits bits;  // in one piece: compilers then leave the memory out
  std::memcpy(&bits, bytes, sizeof bits);
  return bits;
#else
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < sizeof(Bits); ++i) bits |= std::uint64_t{bytes[i]} << 8 * i;
  return static_cast<Bits>(bits);
#endif
}

HWY_INLINE std::uint32_t ray_bits(RayMask mask) { return mask_bits<std::uint16_t>(RayTag(), mask); }

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

/// The least lane of each of four.
struct FourLeast {
  float of[4];

  HWY_INLINE FourLeast(RayVec a, RayVec b, RayVec c, RayVec d) {
#if HWY_TARGET == HWY_SCALAR
    const RayVec each[4] = {a, b, c, d};
    for (std::size_t k = 0; k < 4; ++k) of[k] = hn::GetLane(each[k]);
#else
    const RayTag f;
    const hn::Repartition<std::uint64_t, RayTag> pairs;
    const auto halves = [&](RayVec x, RayVec y) {
      return hn::BitCast(pairs, hn::Min(hn::InterleaveLower(f, x, y), hn::InterleaveUpper(f, x, y)));
    };
    const auto ab = halves(a, b), cd = halves(c, d);
    auto blocks =
        hn::Min(hn::BitCast(f, hn::InterleaveLower(pairs, ab, cd)), hn::BitCast(f, hn::InterleaveUpper(pairs, ab, cd)));
    if constexpr (HWY_LANES(float) > 8) blocks = hn::Min(blocks, hn::ReverseBlocks(f, blocks));
    if constexpr (HWY_LANES(float) > 4) blocks = hn::Min(blocks, hn::SwapAdjacentBlocks(blocks));
    alignas(64) float lanes[kRowLanes];
    hn::Store(blocks, f, lanes);
    std::memcpy(of, lanes, sizeof of);
#endif
  }
};

/// The fields of rays, a vector each.
struct RayFields {
  RayVec origin[3], direction[3], tmin, tmax;
};

/// Of as many rays as there are lanes, from `first` on; of fewer at the end of the span, the others being zero.
HWY_INLINE RayFields load_rays(const RaySpan& rays, std::size_t first) {
  const RayTag f;
  [[maybe_unused]] const std::size_t lanes = hn::Lanes(f);
  alignas(64) Ray copies[kRowLanes];
  const float* values = reinterpret_cast<const float*>(&rays[first]);
  if (rays.stride != sizeof(Ray) || rays.count - first < lanes) {
    std::memset(static_cast<void*>(copies), 0, sizeof copies);
    for (std::size_t k = 0; k < std::min(lanes, rays.count - first); ++k) copies[k] = rays[first + k];
    values = reinterpret_cast<const float*>(copies);
  }
  RayFields r;
#if HWY_TARGET == HWY_SCALAR
  for (std::size_t k = 0; k < 3; ++k) {
    r.origin[k] = hn::LoadU(f, values + k);
    r.direction[k] = hn::LoadU(f, values + 4 + k);
  }
  r.tmin = hn::LoadU(f, values + 3);
  r.tmax = hn::LoadU(f, values + 7);
#else
  RayVec a0, a1, a2, a3, b0, b1, b2, b3;  // origin and direction of a ray by turns
  hn::LoadInterleaved4(f, values, a0, a1, a2, a3);
  hn::LoadInterleaved4(f, values + 4 * lanes, b0, b1, b2, b3);
  r.origin[0] = hn::ConcatEven(f, b0, a0);
  r.origin[1] = hn::ConcatEven(f, b1, a1);
  r.origin[2] = hn::ConcatEven(f, b2, a2);
  r.tmin = hn::ConcatEven(f, b3, a3);
  r.direction[0] = hn::ConcatOdd(f, b0, a0);
  r.direction[1] = hn::ConcatOdd(f, b1, a1);
  r.direction[2] = hn::ConcatOdd(f, b2, a2);
  r.tmax = hn::ConcatOdd(f, b3, a3);
#endif
  return r;
}

/// For what is read some time later.
HWY_INLINE void prefetch_lines(const void* first, std::size_t bytes) {
  constexpr std::size_t kLine = 64;
  for (std::size_t at = 0; at < bytes; at += kLine) hwy::Prefetch(static_cast<const char*>(first) + at);
}

/// For rays that are read some time later, if there are any: as they come from memory, processors fetch too few ahead.
HWY_INLINE void prefetch_rays(const RaySpan& rays, std::size_t first, std::size_t count) {
  constexpr std::size_t kOfLine = 2;
  if (first + count > rays.count) return;
  for (std::size_t i = 0; i < count; i += kOfLine) hwy::Prefetch(&rays[first + i]);
}

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
