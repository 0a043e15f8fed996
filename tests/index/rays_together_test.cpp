// SPDX-License-Identifier: Apache-2.0
//
// Rays that the default kernel answers together, to one light or in bundles from points: each must have the answer that
// it has alone, whatever is asked.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "bundles.h"
#include "two_meshes.h"

namespace umbrix::detail {
namespace {

using MakeRays = std::vector<Ray> (*)();

std::vector<Ray> to_one_light() { return rays_to_light(3000, Vec3(0.3f, 0.9f, -0.2f), 5); }
std::vector<Ray> in_bundles() { return bundles(300, 16, 0.05f, 5); }
std::vector<Ray> in_wide_bundles() { return bundles(300, 16, 0.05f, 5, 2); }

class RaysTogether : public testing::TestWithParam<MakeRays> {};

TEST_P(RaysTogether, MasksHold) {
  const TwoMeshes two;
  for (const std::uint32_t mask : {1u, 2u, 3u}) {
    QueryOptions options;
    options.mask = mask;
    expect_right(two.scene, GetParam()(), options);
  }
}

TEST_P(RaysTogether, SkippedTrianglesAreNotThere) {
  const TwoMeshes two;
  const std::vector<Ray> rays = GetParam()();
  const std::vector<Primitive> skip = first_met(two.scene, rays);
  QueryOptions options;
  options.skip = skip.data();
  expect_right(two.scene, rays, options);
}

TEST_P(RaysTogether, OpacityIsAsked) {
  OpacityTest half;
  half.opaque = [](const void*, std::uint32_t triangle, float u, float v) { return triangle % 2 == 0 || u < v; };
  expect_right(TwoMeshes(half).scene, GetParam()());
}

TEST_P(RaysTogether, AnyIntervalsAndLengths) {
  const TwoMeshes two;
  std::vector<Ray> rays = GetParam()();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const float length = std::ldexp(1.0f, static_cast<int>(i % 41) - 20);
    for (float& x : rays[i].direction) x *= length;
    rays[i].tmax = 1 / length;
    if (i % 3 == 0) rays[i].tmin = 0.25f / length;
    if (i % 7 == 0) rays[i].tmin = -0.25f / length;
  }
  expect_right(two.scene, rays);
}

TEST_P(RaysTogether, SomeRaysMayBeOdd) {
  const TwoMeshes two;
  std::vector<Ray> rays = GetParam()();
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < rays.size(); i += 40) {
    Ray& ray = rays[i];
    switch (i / 40 % 6) {
      case 0:
        ray.tmax = kInfinity;
        break;
      case 1:
        ray.origin[1] = kNaN;
        break;
      case 2:
        ray.tmax = 0.5f;
        break;
      case 3:
        ray.direction[0] = ray.direction[1] = ray.direction[2] = 0;
        break;
      case 4:
        ray.tmin = ray.tmax;
        break;
      default:
        ray.direction[2] = kInfinity;
        break;
    }
  }
  expect_right(two.scene, rays);
}

TEST_P(RaysTogether, RaysMayLieInLargerThings) {
  const TwoMeshes two;
  struct Thing {
    Ray ray;
    char more[20];
  };
  const std::vector<Ray> rays = GetParam()();
  std::vector<Thing> things(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) things[i].ray = rays[i];
  std::vector<std::uint8_t> together(rays.size()), apart(rays.size());
  two.scene.occluded(RaySpan{rays.data(), rays.size()}, together.data());
  two.scene.occluded(RaySpan{&things[0].ray, things.size(), sizeof(Thing)}, apart.data());
  EXPECT_EQ(together, apart);
}

INSTANTIATE_TEST_SUITE_P(Rays, RaysTogether, testing::Values(&to_one_light, &in_bundles, &in_wide_bundles),
                         [](const auto& rays) {
                           return std::string(rays.param == &to_one_light ? "ToOneLight"
                                              : rays.param == &in_bundles ? "InBundles"
                                                                          : "InWideBundles");
                         });

}  // namespace
}  // namespace umbrix::detail
