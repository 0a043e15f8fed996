// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "built_scenes.h"
#include "light_estimates.h"

namespace umbrix::render {
namespace {

constexpr unsigned kSeed = 21;

io::Light environment(const std::shared_ptr<const io::EnvironmentMap>& map, double rotation = 0) {
  io::Light light;
  light.type = io::LightType::environment;
  light.environment = map;
  light.rotation = rotation;
  return light;
}

std::shared_ptr<io::EnvironmentMap> map_of(std::uint32_t width, std::uint32_t height, float value) {
  auto map = std::make_shared<io::EnvironmentMap>();
  map->width = width;
  map->height = height;
  map->pixels.assign(std::size_t{width} * height, {value, value, value});
  return map;
}

io::Float3& pixel(io::EnvironmentMap& map, std::uint32_t x, std::uint32_t y) {
  return map.pixels[std::size_t{y} * map.width + x];
}

/// Of what is seen in the background, by the midpoint rule over the hemisphere.
double irradiance_by_quadrature(const Light& light, const Vec3& normal) {
  constexpr int kRows = 1000, kColumns = 2000;
  double sum = 0;
  for (int row = 0; row < kRows; ++row) {
    const double height = 1 - 2 * (row + 0.5) / kRows, radius = std::sqrt(1 - height * height);
    for (int column = 0; column < kColumns; ++column) {
      const double around = 2 * kPi * (column + 0.5) / kColumns;
      const Vec3 direction(radius * std::cos(around), height, radius * std::sin(around));
      const double cosine = glm::dot(direction, normal);
      if (cosine > 0) sum += light.background(direction).g * cosine;
    }
  }
  return sum * 4 * kPi / (kRows * kColumns);
}

TEST(Environment, WhiteFurnaceIsPiTimesTheRadianceForEveryNormal) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937_64 random(kSeed);
  const World nothing;
  for (const auto& map : {std::shared_ptr<io::EnvironmentMap>(), map_of(1, 1, 1), map_of(7, 5, 1), map_of(64, 32, 1)}) {
    io::Light light = environment(map);
    light.intensity = 3;
    const auto made = make_light(light, nothing);
    for (int i = 0; i < 5; ++i) {
      expect_mean(irradiance(*made, receiver(Vec3(0), unit_vector(random)), random), 3 * kPi);
    }
  }
}

TEST(Environment, ConstantNeedsOneSample) {
  const World nothing;
  const auto light = make_light(environment(nullptr), nothing);
  const Receiver at = receiver(Vec3(1, 2, 3), glm::normalize(Vec3(1, -2, 0.5)));
  for (const double u : {0.01, 0.3, 0.77}) {
    const Arrival arrival = light->sample(at, {u, 1 - u});
    EXPECT_NEAR(arrival.irradiance.r * glm::dot(arrival.to_light, at.normal), kPi, 1e-9);
  }
}

TEST(Environment, MapIsSampledAsItIsSeen) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<float> uniform(0, 1);
  const World nothing;
  for (int kind = 0; kind < 3; ++kind) {
    SCOPED_TRACE(kind);
    // Noise; a sun of one pixel in the dark, which interpolation spreads; a bright pole.
    const auto map = map_of(16, 8, 0);
    if (kind == 0) {
      for (io::Float3& color : map->pixels) color[1] = uniform(random) < 0.7f ? 0 : uniform(random);
    }
    if (kind == 1) pixel(*map, 0, 3)[1] = 1000;
    if (kind == 2) pixel(*map, 5, 0)[1] = 10;
    const auto light = make_light(environment(map, 1.2), nothing);
    for (int i = 0; i < 4; ++i) {
      const Vec3 normal = unit_vector(random);
      const Mean mean = irradiance(*light, receiver(Vec3(0), normal), random);
      const double expected = irradiance_by_quadrature(*light, normal);
      // The quadrature of a tent function is good to the square of its step.
      EXPECT_NEAR(mean.value, expected, 5 * mean.error + 1e-4 * expected) << "standard error " << mean.error;
    }
  }
}

TEST(Environment, MiddleOfTheMapIsAheadAndItsLeftHalfIsAtPlusX) {
  const World nothing;
  const auto map = map_of(8, 4, 0);
  for (std::uint32_t y = 0; y < 4; ++y) {
    pixel(*map, 3, y) = pixel(*map, 4, y) = {1, 0, 0};
    pixel(*map, 1, y) = pixel(*map, 2, y) = {0, 1, 0};
  }
  for (std::uint32_t x = 0; x < 8; ++x) pixel(*map, x, 0)[2] = 1;
  const auto light = make_light(environment(map), nothing);
  EXPECT_EQ(light->background(Vec3(0, 0, 1)), Rgb(1, 0, 0));
  EXPECT_EQ(light->background(Vec3(1, 0, 0)), Rgb(0, 1, 0));
  EXPECT_EQ(light->background(Vec3(-1, 0, 0)), Rgb(0));
  EXPECT_EQ(light->background(Vec3(0, 1, 0)).b, 1);
  EXPECT_EQ(light->background(Vec3(0, -1, 0)).b, 0);
  // A quarter turn, counter-clockwise from above, carries +z to +x.
  const auto turned = make_light(environment(map, kPi / 2), nothing);
  EXPECT_NEAR(turned->background(Vec3(1, 0, 0)).r, 1, 1e-12);
}

TEST(Environment, BlackMapIsNoLight) {
  const World nothing;
  const auto light = make_light(environment(map_of(4, 2, 0)), nothing);
  EXPECT_EQ(light->sample(receiver(Vec3(0), Vec3(0, 1, 0)), {0.5, 0.5}).unreached, Unreached::no_power);
  EXPECT_EQ(light->power(), 0);
}

}  // namespace
}  // namespace umbrix::render
