// SPDX-License-Identifier: Apache-2.0
#include "render/pixel_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>
#include <vector>

namespace umbrix::render {
namespace {

std::vector<SamplePoint> samples_of(std::uint32_t x, std::uint32_t y, std::uint32_t count, std::uint64_t seed = 1) {
  std::vector<SamplePoint> samples;
  for (std::uint32_t i = 0; i < count; ++i) samples.push_back(pixel_sample(x, y, i, count, seed));
  return samples;
}

TEST(PixelSamples, LieInThePixel) {
  for (std::uint32_t count = 1; count < 70; ++count) {
    for (const SamplePoint& s : samples_of(count, 3, count)) {
      EXPECT_TRUE(s.x >= 0 && s.x < 1 && s.y >= 0 && s.y < 1) << count;
    }
  }
}

TEST(PixelSamples, OneIsTheCentre) {
  EXPECT_EQ(samples_of(5, 6, 1)[0].x, 0.5);
  EXPECT_EQ(samples_of(5, 6, 1)[0].y, 0.5);
}

TEST(PixelSamples, FillEachRowOfAnyCount) {
  for (const std::uint32_t count : {2u, 3u, 5u, 7u, 13u, 16u, 31u, 64u}) {
    for (std::uint32_t pixel = 0; pixel < 20; ++pixel) {
      std::set<int> rows;
      for (const SamplePoint& s : samples_of(pixel, 9, count)) rows.insert(static_cast<int>(s.y * count));
      EXPECT_EQ(rows.size(), count) << "pixel " << pixel;
    }
  }
}

TEST(PixelSamples, FillEachCellAndEachColumnOfASquareCount) {
  for (const int side : {2, 3, 4, 8}) {
    for (std::uint32_t pixel = 0; pixel < 20; ++pixel) {
      std::set<std::pair<int, int>> cells;
      std::set<int> columns;
      for (const SamplePoint& s : samples_of(pixel, 2, static_cast<std::uint32_t>(side * side))) {
        cells.insert({static_cast<int>(s.x * side), static_cast<int>(s.y * side)});
        columns.insert(static_cast<int>(s.x * side * side));
      }
      EXPECT_EQ(cells.size(), static_cast<std::size_t>(side * side)) << "pixel " << pixel;
      EXPECT_EQ(columns.size(), static_cast<std::size_t>(side * side)) << "pixel " << pixel;
    }
  }
}

TEST(PixelSamples, DifferBetweenPixelsAndSeeds) {
  const SamplePoint here = samples_of(4, 4, 16)[0];
  EXPECT_NE(here.x, samples_of(5, 4, 16)[0].x);
  EXPECT_NE(here.x, samples_of(4, 5, 16)[0].x);
  EXPECT_NE(here.x, samples_of(4, 4, 16, 2)[0].x);
}

TEST(PixelSamples, AreUnbiasedOverPixels) {
  constexpr std::uint32_t kSide = 64, kCount = 5;
  double x = 0, y = 0;
  for (std::uint32_t pixel = 0; pixel < kSide * kSide; ++pixel) {
    const SamplePoint s = pixel_sample(pixel % kSide, pixel / kSide, 2, kCount, 11);
    x += s.x;
    y += s.y;
  }
  // Five standard errors of a uniform mean.
  const double bound = 5 * std::sqrt(1.0 / 12) / kSide;
  EXPECT_NEAR(x / (kSide * kSide), 0.5, bound);
  EXPECT_NEAR(y / (kSide * kSide), 0.5, bound);
}

}  // namespace
}  // namespace umbrix::render
