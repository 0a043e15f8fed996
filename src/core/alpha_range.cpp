// SPDX-License-Identifier: Apache-2.0
#include "core/alpha_range.h"

#include <algorithm>

namespace umbrix::detail {
namespace {

constexpr std::uint32_t kBlock = 8;        // texels along a side of a block of the first level
constexpr std::uint32_t kMostTexels = 16;  // along a side of a rectangle that is looked at one by one
constexpr std::uint32_t kMostBlocks = 4;   // of larger ones

std::int64_t floor_mod(std::int64_t value, std::int64_t period) noexcept {
  const std::int64_t rest = value % period;
  return rest < 0 ? rest + period : rest;
}

/// At most two runs of texels.
struct Runs {
  std::uint32_t first[2];
  std::uint32_t last[2];
  int count = 0;

  void add(std::int64_t from, std::int64_t to) noexcept {
    first[count] = static_cast<std::uint32_t>(from);
    last[count++] = static_cast<std::uint32_t>(to);
  }
};

/// The texels of an axis that a span names.
Runs wrapped(Wrap wrap, std::int64_t size, const TexelSpan& span) noexcept {
  Runs runs;
  const std::int64_t steps = span.last - span.first;
  if (wrap == Wrap::clamp) {
    runs.add(std::clamp<std::int64_t>(span.first, 0, size - 1), std::clamp<std::int64_t>(span.last, 0, size - 1));
  } else if (steps >= size - 1) {
    runs.add(0, size - 1);
  } else if (wrap == Wrap::repeat) {
    const std::int64_t first = floor_mod(span.first, size), last = first + steps;
    runs.add(first, std::min(last, size - 1));
    if (last >= size) runs.add(0, last - size);
  } else {
    // Forth over [0, size), back over [size, 2 size).
    const std::int64_t first = floor_mod(span.first, 2 * size), last = first + steps;
    if (first < size) runs.add(first, std::min(last, size - 1));
    if (last >= size && first < 2 * size) {
      runs.add(2 * size - 1 - std::min(last, 2 * size - 1), 2 * size - 1 - std::max(first, size));
    }
    if (last >= 2 * size) runs.add(0, last - 2 * size);
  }
  return runs;
}

}  // namespace

void ByteRange::add(std::uint8_t value) noexcept {
  low = std::min(low, value);
  high = std::max(high, value);
}

void ByteRange::add(const ByteRange& other) noexcept {
  low = std::min(low, other.low);
  high = std::max(high, other.high);
}

AlphaRanges::AlphaRanges(const AlphaMap& map) : map_(map) {
  const auto make_level = [&](std::uint32_t width, std::uint32_t height, std::uint32_t shrink) -> Level& {
    Level& level = levels_.emplace_back();
    level.width = (width - 1) / shrink + 1;
    level.height = (height - 1) / shrink + 1;
    level.blocks.resize(std::size_t{level.width} * level.height);
    return level;
  };
  Level* level = &make_level(map.width, map.height, kBlock);
  for (std::uint32_t y = 0; y < map.height; ++y) {
    ByteRange* const row = &level->blocks[std::size_t{y / kBlock} * level->width];
    for (std::uint32_t x = 0; x < map.width; ++x) row[x / kBlock].add(alpha_byte(map, x, y));
  }
  while (level->width > 1 || level->height > 1) {
    const std::size_t below = levels_.size() - 1;
    level = &make_level(level->width, level->height, 2);
    const Level& from = levels_[below];
    for (std::uint32_t y = 0; y < from.height; ++y) {
      for (std::uint32_t x = 0; x < from.width; ++x) {
        level->blocks[std::size_t{y / 2} * level->width + x / 2].add(from.blocks[std::size_t{y} * from.width + x]);
      }
    }
  }
}

void AlphaRanges::add_rectangle(std::uint32_t x0, std::uint32_t x1, std::uint32_t y0, std::uint32_t y1,
                                ByteRange& out) const {
  if (std::max(x1 - x0, y1 - y0) < kMostTexels) {
    for (std::uint32_t y = y0; y <= y1; ++y) {
      for (std::uint32_t x = x0; x <= x1; ++x) out.add(alpha_byte(map_, x, y));
    }
    return;
  }
  std::size_t number = 0;
  std::uint32_t size = kBlock;
  while (number + 1 < levels_.size() && std::max(x1 / size - x0 / size, y1 / size - y0 / size) >= kMostBlocks) {
    ++number;
    size *= 2;
  }
  const Level& level = levels_[number];
  for (std::uint32_t y = y0 / size; y <= y1 / size; ++y) {
    for (std::uint32_t x = x0 / size; x <= x1 / size; ++x) out.add(level.blocks[std::size_t{y} * level.width + x]);
  }
}

ByteRange AlphaRanges::range(const TexelSpan& across, const TexelSpan& down) const {
  const Runs columns = wrapped(map_.sampler.wrap_u, map_.width, across);
  const Runs rows = wrapped(map_.sampler.wrap_v, map_.height, down);
  ByteRange out;
  for (int r = 0; r < rows.count; ++r) {
    for (int c = 0; c < columns.count; ++c) {
      add_rectangle(columns.first[c], columns.last[c], rows.first[r], rows.last[r], out);
    }
  }
  return out;
}

}  // namespace umbrix::detail
