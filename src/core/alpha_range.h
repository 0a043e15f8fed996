// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "umbrix/opacity.h"

namespace umbrix::detail {

/// Least and greatest alpha of some texels.
struct ByteRange {
  std::uint8_t low = 255;
  std::uint8_t high = 0;

  void add(std::uint8_t value) noexcept;
  void add(const ByteRange& other) noexcept;
};

/// The texels' indices from `first` to `last` on an endless axis, before wrapping.
struct TexelSpan {
  std::int64_t first;
  std::int64_t last;
};

/// Bounds the alpha of any rectangle of an image, by ranges of blocks of texels and of blocks of blocks: few reads for
/// rectangles of any size.
class AlphaRanges {
 public:
  explicit AlphaRanges(const AlphaMap& map);

  /// Contains the alpha of all texels that the spans name once wrapped; more where they are large.
  ByteRange range(const TexelSpan& across, const TexelSpan& down) const;

 private:
  struct Level {
    std::uint32_t width = 0;  ///< in blocks
    std::uint32_t height = 0;
    std::vector<ByteRange> blocks;
  };

  void add_rectangle(std::uint32_t x0, std::uint32_t x1, std::uint32_t y0, std::uint32_t y1, ByteRange& out) const;

  const AlphaMap& map_;
  std::vector<Level> levels_;
};

/// One byte of a map's image.
inline std::uint8_t alpha_byte(const AlphaMap& map, std::uint32_t x, std::uint32_t y) noexcept {
  const std::size_t row = map.row_stride > 0 ? map.row_stride : map.width * map.pixel_stride;
  return map.image[y * row + x * map.pixel_stride];
}

}  // namespace umbrix::detail
