// SPDX-License-Identifier: Apache-2.0
// Measures of how far images are apart, against their definitions.
#include "render/image_metrics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace umbrix::render {
namespace {

TEST(ImageError, OfAConstantDifference) {
  constexpr double kSumRounding = 3000 * 0x1p-53;  // of as many terms
  const RgbValues reference(3 * 1000, 2.0);
  RgbValues image(reference.size(), 2.5);
  ImageError error = image_error(image, reference);
  EXPECT_DOUBLE_EQ(error.rmse, 0.5);
  EXPECT_NEAR(error.relmse, 0.25 / (4 + 0.01 * 4), kSumRounding);
  EXPECT_DOUBLE_EQ(error.mean_difference, 0.5);
  EXPECT_DOUBLE_EQ(error.rmse_trimmed, 0.5);

  // One wild pixel of a thousand is all that trimming takes away.
  for (std::size_t i = 300; i < 303; ++i) image[i] = 1002;
  error = image_error(image, reference);
  EXPECT_DOUBLE_EQ(error.rmse, std::sqrt((999 * 0.25 + 1e6) / 1000));
  EXPECT_DOUBLE_EQ(error.rmse_trimmed, 0.5);
  EXPECT_NEAR(error.relmse_trimmed, 0.25 / 4.04, kSumRounding);
}

TEST(ImageError, OfBlackImagesIsZero) {
  const ImageError error = image_error(RgbValues(30, 0.0), RgbValues(30, 0.0));
  EXPECT_EQ(error.rmse, 0);
  EXPECT_EQ(error.relmse, 0);
}

TEST(NoiseOfMean, IsWhatRemainsAfterAveraging) {
  // Two images with independent noise of variance 1 around 5: their mean has the variance 1/2.
  constexpr std::size_t kPixels = 40'000;
  std::uint64_t state = 1;
  const auto noise = [&state] {  // of variance 1: uniform, by a linear congruential generator (Knuth's MMIX)
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (static_cast<double>(state >> 11) * 0x1p-53 - 0.5) * std::sqrt(12.0);
  };
  RgbValues a(3 * kPixels), b(3 * kPixels);
  for (std::size_t i = 0; i < a.size(); ++i) {
    a[i] = 5 + noise();
    b[i] = 5 + noise();
  }
  const ImageError estimate = noise_of_mean(a, b);
  // The relative standard error of a root mean square of n values is about 1 / sqrt(2 n); five of them.
  EXPECT_NEAR(estimate.rmse, std::sqrt(0.5), std::sqrt(0.5) * 5 / std::sqrt(6.0 * kPixels));
  EXPECT_DOUBLE_EQ(estimate.mean_difference, estimate.rmse / std::sqrt(static_cast<double>(kPixels)));
}

TEST(RgbOf, TakesTheFirstThreeChannels) {
  io::Image image;
  image.width = 2;
  image.height = 1;
  image.channels = {"R", "G", "B", "A"};
  image.pixels = {1, 2, 3, 9, 4, 5, 6, 9};
  EXPECT_EQ(rgb_of(image), (RgbValues{1, 2, 3, 4, 5, 6}));
}

}  // namespace
}  // namespace umbrix::render
