// SPDX-License-Identifier: Apache-2.0
// Statistics and image metrics of error reports, against their definitions.
#include <gtest/gtest.h>

#include <cmath>

#include "error/image_metrics.h"
#include "error/statistics.h"

namespace umbrix::bench {
namespace {

/// P(X <= count) for X binomial, summed term by term.
double at_most(std::uint64_t count, std::uint64_t trials, double p) {
  double sum = 0;
  for (std::uint64_t k = 0; k <= count; ++k) {
    const auto n = static_cast<double>(trials), x = static_cast<double>(k);
    sum += std::exp(std::lgamma(n + 1) - std::lgamma(x + 1) - std::lgamma(n - x + 1) + x * std::log(p) +
                    (n - x) * std::log1p(-p));
  }
  return sum;
}

TEST(ShareOf, EndsWhereTheTailsHaveTwoAndAHalfPercent) {
  for (const auto& [count, trials] : {std::pair<std::uint64_t, std::uint64_t>{1, 20}, {7, 50}, {3, 100'000}}) {
    const Estimate share = share_of(count, trials);
    EXPECT_EQ(share.value, static_cast<double>(count) / static_cast<double>(trials));
    EXPECT_NEAR(at_most(count, trials, share.high), 0.025, 1e-8);
    EXPECT_NEAR(1 - at_most(count - 1, trials, share.low), 0.025, 1e-8);
  }
}

TEST(ShareOf, OfNoneAndOfAll) {
  const Estimate none = share_of(0, 1'000'000);
  EXPECT_EQ(none.low, 0);
  EXPECT_NEAR(none.high, 1 - std::pow(0.025, 1e-6), 1e-15);
  EXPECT_EQ(share_of(10, 10).high, 1);
  EXPECT_NEAR(share_of(10, 10).low, std::pow(0.025, 0.1), 1e-12);
  EXPECT_EQ(share_of(0, 0).high, 1);
}

TEST(MedianAndQuartiles, InterpolatesBetweenValues) {
  const Estimate odd = median_and_quartiles({5, 1, 4, 2, 3});
  EXPECT_EQ(odd.low, 2);
  EXPECT_EQ(odd.value, 3);
  EXPECT_EQ(odd.high, 4);
  const Estimate even = median_and_quartiles({1, 2, 3, 4});
  EXPECT_EQ(even.low, 1.75);
  EXPECT_EQ(even.value, 2.5);
  EXPECT_EQ(even.high, 3.25);
}

TEST(MeanInterval, IsStudents) {
  // Of 1 ... 5: mean 3, variance 2.5; t of 4 degrees of freedom is 2.776445 (any table).
  const Estimate mean = mean_interval({1, 2, 3, 4, 5});
  EXPECT_EQ(mean.value, 3);
  EXPECT_NEAR(mean.high - 3, 2.776445 * std::sqrt(0.5), 1e-5);
  EXPECT_NEAR(3 - mean.low, 2.776445 * std::sqrt(0.5), 1e-5);
  EXPECT_NEAR(mean_interval({2, 2, 2, 2, 2}, 0.25).high - 2, 2.776445 * 0.5, 1e-5) << "what all values share";
  EXPECT_TRUE(std::isinf(mean_interval({7}).high));
}

TEST(ImageError, OfAConstantDifference) {
  constexpr double kSumRounding = 3000 * 0x1p-53;  // of as many terms
  const Rgb reference(3 * 1000, 2.0);
  Rgb image(reference.size(), 2.5);
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
  const ImageError error = image_error(Rgb(30, 0.0), Rgb(30, 0.0));
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
  Rgb a(3 * kPixels), b(3 * kPixels);
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
  EXPECT_EQ(rgb_of(image), (Rgb{1, 2, 3, 4, 5, 6}));
}

}  // namespace
}  // namespace umbrix::bench
