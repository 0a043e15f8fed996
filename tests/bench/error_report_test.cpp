// SPDX-License-Identifier: Apache-2.0
// Statistics of error reports, against their definitions.
#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace
}  // namespace umbrix::bench
