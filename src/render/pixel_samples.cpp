// SPDX-License-Identifier: Apache-2.0
// Correlated multi-jittered sampling (Kensler 2013, "Correlated Multi-Jittered Sampling", Pixar 13-01): a grid of
// strata whose cells are also permuted so that each axis alone is stratified into `count` parts, for any count.
// The permutations are Kensler's hashes with cycle walking, so nothing is stored.
#include "render/pixel_samples.h"

#include <algorithm>
#include <cmath>

namespace umbrix::render {
namespace {

/// Steele, Lea & Flood 2014, "Fast splittable pseudorandom number generators": the finaliser of SplitMix64.
std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

std::uint32_t hash_word(std::uint32_t value, std::uint32_t pattern) {
  return static_cast<std::uint32_t>(mix((std::uint64_t{pattern} << 32 | value) + 0x9E3779B97F4A7C15u));
}

double unit_random(std::uint32_t value, std::uint32_t pattern) { return hash_word(value, pattern) * 0x1p-32; }

/// Sends i < length to another number below it; a bijection for each pattern. A bijection of the next power of two is
/// repeated until it lands inside.
std::uint32_t permute(std::uint32_t i, std::uint32_t length, std::uint32_t pattern) {
  std::uint32_t bits = length - 1;
  for (int shift = 1; shift < 32; shift *= 2) bits |= bits >> shift;
  do {
    i = (i ^ pattern) & bits;
    i = (i * 0xE170893Du) & bits;  // odd factors and xor-shifts to the right are bijections modulo 2^k
    i ^= ((i ^ (pattern >> 16)) & bits) >> 4;
    i ^= i >> 1;
    i = (i * (0x929EB3F1u ^ ((pattern & 0x40000000u) >> 8))) & bits;
    i ^= i >> 2;
    i = (i + (pattern >> 8)) & bits;
    i = (i * 0x0929EB3Fu) & bits;
    i ^= i >> 3;
  } while (i >= length);
  return (i + pattern) % length;
}

std::uint32_t pixel_pattern(std::uint32_t x, std::uint32_t y, std::uint64_t seed) {
  return static_cast<std::uint32_t>(mix(mix(std::uint64_t{y} << 32 | x) ^ seed));
}

SamplePoint multi_jittered(std::uint32_t index, std::uint32_t count, std::uint32_t pattern) {
  // Shuffle the order, so that the first samples of a pixel are not all in its upper rows.
  const std::uint32_t s = permute(index, count, pattern * 0x51633E2Du);

  // Choose the cell of a columns x rows grid, then the sub-cell that stratifies each axis alone.
  const auto columns = std::max(1u, static_cast<std::uint32_t>(std::sqrt(static_cast<double>(count))));
  const std::uint32_t rows = (count + columns - 1) / columns;
  const std::uint32_t column = permute(s % columns, columns, pattern * 0x68BC21EBu);
  const std::uint32_t row = permute(s / columns, rows, pattern * 0x02E5BE93u);
  const double jitter_x = unit_random(s, pattern * 0x967A889Bu);
  const double jitter_y = unit_random(s, pattern * 0x368CC8B7u);
  return {(column + (row + jitter_x) / rows) / columns, (s + jitter_y) / count};
}

}  // namespace

SamplePoint pixel_sample(std::uint32_t x, std::uint32_t y, std::uint32_t index, std::uint32_t count,
                         std::uint64_t seed) {
  if (count <= 1) return {0.5, 0.5};
  return multi_jittered(index, count, pixel_pattern(x, y, seed));
}

SamplePoint purpose_sample(std::uint32_t x, std::uint32_t y, std::uint32_t purpose, std::uint32_t index,
                           std::uint32_t count, std::uint64_t seed) {
  return multi_jittered(index, count, hash_word(purpose, pixel_pattern(x, y, seed)));
}

}  // namespace umbrix::render
