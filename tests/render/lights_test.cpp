// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "built_scenes.h"
#include "render/lights/light.h"

namespace umbrix::render {
namespace {

Arrival arrive(const io::Light& light, const Vec3& point) {
  const World nothing;
  return make_light(light, nothing)->sample({point, point, Vec3(0, 0, 1)}, {});
}

io::Light spot_down(float inner, float outer) {
  io::Light light = point_light({0, 0, 2}, 8);
  light.type = io::LightType::spot;
  light.inner_cone_angle = inner;
  light.outer_cone_angle = outer;
  return light;
}

/// A point at distance 1 from the spot, `angle` off its axis.
Vec3 off_axis(double angle) { return Vec3(std::sin(angle), 0, 2 - std::cos(angle)); }

TEST(Lights, PointFallsWithTheSquareOfDistance) {
  const io::Light light = point_light({1, 2, 3}, 10);
  EXPECT_NEAR(arrive(light, Vec3(1, 2, 1)).irradiance.r, 10.0 / 4, 1e-12);
  EXPECT_NEAR(arrive(light, Vec3(1, 2, -3)).irradiance.r, 10.0 / 36, 1e-12);
}

TEST(Lights, PointIsAtTheEndOfItsRay) {
  const Arrival arrival = arrive(point_light({1, 2, 3}, 10), Vec3(1, 0, 0));
  EXPECT_EQ(arrival.to_light, Vec3(0, 2, 3));
  EXPECT_EQ(arrival.tmax, 1);
}

TEST(Lights, RangeEndsTheLightSmoothly) {
  io::Light light = point_light({0, 0, 0}, 1);
  light.range = 2;
  EXPECT_NEAR(arrive(light, Vec3(1, 0, 0)).irradiance.r, 1 - 1.0 / 16, 1e-12);
  EXPECT_LT(arrive(light, Vec3(1.999, 0, 0)).irradiance.r, 1e-3);
  EXPECT_EQ(arrive(light, Vec3(2, 0, 0)).unreached, Unreached::beyond_range);
  EXPECT_EQ(arrive(light, Vec3(1.999, 0, 0)).unreached, Unreached::no);
}

TEST(Lights, PointOnTheLightItselfGetsNothing) {
  EXPECT_EQ(arrive(point_light({1, 2, 3}, 10), Vec3(1, 2, 3)).unreached, Unreached::no_power);
}

TEST(Lights, SpotIsFullWithinTheInnerConeAndNothingOutsideTheOuter) {
  const io::Light light = spot_down(0.2f, 0.6f);
  EXPECT_NEAR(arrive(light, off_axis(0)).irradiance.r, 8, 1e-9);
  EXPECT_NEAR(arrive(light, off_axis(0.19)).irradiance.r, 8, 1e-9);
  EXPECT_EQ(arrive(light, off_axis(0.61)).unreached, Unreached::outside_cone);
  EXPECT_EQ(arrive(light, off_axis(kPi)).unreached, Unreached::outside_cone);
  // Halfway in the cosine, the square of one half.
  const double middle = std::acos((std::cos(double{0.2f}) + std::cos(double{0.6f})) / 2);
  EXPECT_NEAR(arrive(light, off_axis(middle)).irradiance.r, 8 * 0.25, 1e-9);
}

TEST(Lights, SpotOfEqualConesIsFiniteAndSharp) {
  const io::Light light = spot_down(0.5f, 0.5f);
  EXPECT_NEAR(arrive(light, off_axis(0.49)).irradiance.r, 8, 1e-9);
  EXPECT_EQ(arrive(light, off_axis(0.51)).unreached, Unreached::outside_cone);
}

TEST(Lights, DirectionalIsTheSameEverywhereAndInfinitelyFar) {
  io::Light light;
  light.type = io::LightType::directional;
  light.intensity = 3;
  light.color = {1, 0.5f, 0};
  light.direction = {0, 0, -1};
  for (const Vec3& point : {Vec3(0), Vec3(1e6, -5, 7)}) {
    const Arrival arrival = arrive(light, point);
    EXPECT_EQ(arrival.irradiance, Rgb(3, 1.5, 0));
    EXPECT_EQ(arrival.to_light, Vec3(0, 0, 1));
    EXPECT_TRUE(std::isinf(arrival.tmax));
  }
}

TEST(Lights, EveryTypeIsFoundByItsName) {
  for (const io::LightTypeInfo& info : io::kLightTypes) {
    io::LightType type;
    ASSERT_TRUE(io::find_light_type(info.name, type));
    EXPECT_STREQ(io::light_type_info(type).name, info.name);
  }
}

}  // namespace
}  // namespace umbrix::render
