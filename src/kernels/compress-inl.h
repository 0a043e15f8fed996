// SPDX-License-Identifier: Apache-2.0
// Lanes brought together. With AVX2, compilers (GCC 12) copy the kilobyte of Highway 1.0's table to the stack at each
// use; this table stays where it is.

#if defined(UMBRIX_KERNELS_COMPRESS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_COMPRESS_INL_H_
#undef UMBRIX_KERNELS_COMPRESS_INL_H_
#else
#define UMBRIX_KERNELS_COMPRESS_INL_H_
#endif

#include <hwy/highway.h>

#include <cstdint>

#include "kernels/ray_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

#if HWY_TARGET == HWY_AVX2
/// By mask: the lanes that it has, a byte each, then those that it has not.
struct CompressTable {
  alignas(8) std::uint8_t lanes[256][8];

  constexpr CompressTable() : lanes() {
    for (std::uint32_t mask = 0; mask < 256; ++mask) {
      std::uint32_t place = 0;
      for (std::uint32_t pass = 0; pass < 2; ++pass)
        for (std::uint32_t lane = 0; lane < 8; ++lane)
          if ((mask >> lane & 1) == 1 - pass) lanes[mask][place++] = static_cast<std::uint8_t>(lane);
    }
  }
};
inline constexpr CompressTable kCompressTable;
#endif

/// The lanes of a mask first. Others after them mean nothing.
template <class V, class Mask>
HWY_INLINE V compress(V v, Mask mask) {
#if HWY_TARGET == HWY_AVX2
  const hn::DFromV<V> d;
  const hn::RebindToUnsigned<hn::DFromV<V>> n;
  const hn::Rebind<std::uint8_t, hn::DFromV<V>> bytes;
  const auto lanes = hn::Load(bytes, kCompressTable.lanes[mask_bits<std::uint8_t>(d, mask)]);
  return hn::TableLookupLanes(v, hn::IndicesFromVec(d, hn::PromoteTo(n, lanes)));
#else
  return hn::Compress(v, mask);
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
