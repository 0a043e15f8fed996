// SPDX-License-Identifier: Apache-2.0
#include "render/pixel_filter.h"

#include <gtest/gtest.h>

#include <cmath>

namespace umbrix::render {
namespace {

/// The variance of the places that a filter chooses.
double variance(PixelFilter filter) {
  constexpr int kSteps = 100000;
  const FilterSampler sampler(filter);
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double x = sampler.offset((i + 0.5) / kSteps);
    sum += x * x;
  }
  return sum / kSteps;
}

TEST(PixelFilter, PlacesHaveTheFiltersVariance) {
  EXPECT_NEAR(variance(PixelFilter::box), 1.0 / 12, 1e-4);
  EXPECT_NEAR(variance(PixelFilter::triangle), 1.0 / 6, 1e-4);
  // By the trapezoid rule over the formulas: a normal distribution of deviation 0.5 cut at three deviations and brought
  // to 0 there, and the window.
  EXPECT_NEAR(variance(PixelFilter::gaussian), 0.2295, 1e-3);
  EXPECT_NEAR(variance(PixelFilter::blackman_harris), 0.1727, 1e-3);
}

TEST(PixelFilter, PlacesAreSymmetricAndALoneSampleIsTheCentre) {
  for (const PixelFilter filter :
       {PixelFilter::box, PixelFilter::triangle, PixelFilter::gaussian, PixelFilter::blackman_harris}) {
    const FilterSampler sampler(filter);
    EXPECT_EQ(sampler.offset(0.5), 0);
    for (const double u : {0.0, 0.1, 0.3, 0.499}) {
      EXPECT_LT(sampler.offset(u), 0);
      EXPECT_NEAR(sampler.offset(u), -sampler.offset(1 - u), 1e-12);
      EXPECT_LE(std::abs(sampler.offset(u)), 1.5);
    }
  }
}

}  // namespace
}  // namespace umbrix::render
