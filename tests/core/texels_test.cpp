// SPDX-License-Identifier: Apache-2.0
#include "umbrix/texels.h"

#include <gtest/gtest.h>

#include <limits>

namespace umbrix {
namespace {

// Four texels in a row, each worth ten times its number.
double at(const TexelSampler& sampler, double u) {
  return texels_at(sampler, 4, 1, u, 0.5).blend([](std::uint32_t x, std::uint32_t) { return 10.0 * x; });
}

TEST(Texels, CentresHaveTheirOwnValueAndBetweenThemItIsLinear) {
  const TexelSampler sampler;
  for (int i = 0; i < 4; ++i) EXPECT_EQ(at(sampler, (i + 0.5) / 4), 10 * i);
  EXPECT_EQ(at(sampler, 0.5), 15);
  EXPECT_EQ(at(sampler, 0.4375), 12.5);
}

TEST(Texels, EdgesWrapAsTheSamplerSays) {
  const TexelSampler repeat{Wrap::repeat, Wrap::repeat, false}, clamp{Wrap::clamp, Wrap::clamp, false},
      mirror{Wrap::mirror, Wrap::mirror, false};
  EXPECT_EQ(at(repeat, 0), 15) << "half the last, half the first";
  EXPECT_EQ(at(repeat, 1), 15);
  EXPECT_EQ(at(repeat, -0.125), 30);
  EXPECT_EQ(at(repeat, 7.375), 10);
  EXPECT_EQ(at(clamp, 0), 0);
  EXPECT_EQ(at(clamp, 1), 30);
  EXPECT_EQ(at(clamp, -5), 0);
  EXPECT_EQ(at(clamp, 5), 30);
  EXPECT_EQ(at(mirror, 1), 30);
  EXPECT_EQ(at(mirror, 1.125), 30);
  EXPECT_EQ(at(mirror, 1.875), 0);
  EXPECT_EQ(at(mirror, -0.375), 10);
  EXPECT_EQ(at(mirror, 2.375), 10);
}

TEST(Texels, NearestTakesTheTexelThatHoldsThePoint) {
  const TexelSampler nearest{Wrap::repeat, Wrap::repeat, true};
  EXPECT_EQ(at(nearest, 0.24), 0);
  EXPECT_EQ(at(nearest, 0.26), 10);
  EXPECT_EQ(at(nearest, -0.01), 30);
  EXPECT_EQ(at(nearest, 1), 0);
  EXPECT_EQ(at({Wrap::clamp, Wrap::clamp, true}, 1), 30);
}

TEST(Texels, RowsGoDownFromTheTop) {
  const TexelQuad quad = texels_at({}, 1, 2, 0.5, 0.25);
  EXPECT_EQ(quad.blend([](std::uint32_t, std::uint32_t y) { return 1.0 + y; }), 1);
}

// Whatever files hold as coordinates, texels are within the image.
TEST(Texels, AnyCoordinatesLeadIntoTheImage) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double u : {kInfinity, -kInfinity, std::numeric_limits<double>::quiet_NaN(), 1e300, -1e300, -1e-300, 0.0,
                         1.0, -0.0, 0x1p53 + 1, 1 - 0x1p-53, -0x1p-60}) {
    for (const Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::mirror}) {
      for (const bool nearest : {false, true}) {
        for (const std::uint32_t size : {1u, 2u, 3u, 16384u}) {
          const TexelQuad quad = texels_at({wrap, wrap, nearest}, size, size, u, u);
          for (std::size_t i = 0; i < 2; ++i) {
            EXPECT_LT(quad.x[i], size) << u;
            EXPECT_LT(quad.y[i], size) << u;
          }
          EXPECT_TRUE(quad.fx >= 0 && quad.fx <= 1 && quad.fy >= 0 && quad.fy <= 1) << u;
        }
      }
    }
  }
}

}  // namespace
}  // namespace umbrix
