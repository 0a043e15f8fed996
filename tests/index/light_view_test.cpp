// SPDX-License-Identifier: Apache-2.0
//
// Many rays to one light, which the default kernel answers together: each must have the answer that it has alone.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "two_meshes.h"

namespace umbrix::detail {
namespace {

constexpr std::size_t kRays = 3000;

std::vector<Ray> some_rays() { return rays_to_light(kRays, Vec3(0.3f, 0.9f, -0.2f), 5); }

TEST(LightView, MasksHold) {
  const TwoMeshes two;
  for (const std::uint32_t mask : {1u, 2u, 3u}) {
    QueryOptions options;
    options.mask = mask;
    expect_right(two.scene, some_rays(), options);
  }
}

TEST(LightView, SkippedTrianglesAreNotThere) {
  const TwoMeshes two;
  const std::vector<Ray> rays = some_rays();
  std::vector<Primitive> skip(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    Hit hit;
    if (two.scene.closest(rays[i], hit)) skip[i] = hit.primitive;
  }
  QueryOptions options;
  options.skip = skip.data();
  expect_right(two.scene, rays, options);
}

TEST(LightView, OpacityIsAsked) {
  OpacityTest half;
  half.opaque = [](const void*, std::uint32_t triangle, float u, float v) { return triangle % 2 == 0 || u < v; };
  expect_right(TwoMeshes(half).scene, some_rays());
}

TEST(LightView, AnyIntervalsAndLengths) {
  const TwoMeshes two;
  std::vector<Ray> rays = some_rays();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const float length = std::ldexp(1.0f, static_cast<int>(i % 41) - 20);
    for (float& x : rays[i].direction) x *= length;
    rays[i].tmax = 1 / length;
    if (i % 3 == 0) rays[i].tmin = 0.25f / length;
    if (i % 7 == 0) rays[i].tmin = -0.25f / length;
  }
  expect_right(two.scene, rays);
}

TEST(LightView, SomeRaysMayBeOdd) {
  const TwoMeshes two;
  std::vector<Ray> rays = some_rays();
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

TEST(LightView, LightsByTurnsAreAnsweredOtherwise) {
  const TwoMeshes two;
  std::vector<Ray> rays = some_rays();
  const std::vector<Ray> others = rays_to_light(kRays, Vec3(-0.9f, 0.1f, 0.4f), 6);
  for (std::size_t i = 0; i < rays.size(); i += 2) rays[i] = others[i];
  expect_right(two.scene, rays);
}

TEST(LightView, RaysMayLieInLargerThings) {
  const TwoMeshes two;
  struct Thing {
    Ray ray;
    char more[20];
  };
  const std::vector<Ray> rays = some_rays();
  std::vector<Thing> things(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) things[i].ray = rays[i];
  std::vector<std::uint8_t> together(rays.size()), apart(rays.size());
  two.scene.occluded(RaySpan{rays.data(), rays.size()}, together.data());
  two.scene.occluded(RaySpan{&things[0].ray, things.size(), sizeof(Thing)}, apart.data());
  EXPECT_EQ(together, apart);
}

TEST(LightView, ManyRaysFromEverywhereAreSorted) {
  // So many that they come in an order that the light cannot use, and are brought into one.
  const TwoMeshes two;
  const std::vector<Ray> rays = rays_to_light(100000, Vec3(0.1f, 0.2f, 0.3f), 9);
  std::vector<std::uint8_t> answers(rays.size());
  two.scene.occluded(RaySpan{rays.data(), rays.size()}, answers.data());
  for (std::size_t i = 0; i < rays.size(); ++i) ASSERT_EQ(answers[i] != 0, two.scene.occluded(rays[i])) << i;
}

TEST(LightView, OneWalkServesAllRays) {
  const TwoMeshes two;
  const std::vector<Ray> rays = some_rays();
  std::vector<std::uint8_t> answers(rays.size());
  OcclusionCounts together, alone;
  two.scene.occluded(RaySpan{rays.data(), rays.size()}, answers.data(), together);
  QueryOptions standard;
  ASSERT_TRUE(find_kernel("standard", standard.kernel).ok());
  two.scene.occluded(RaySpan{rays.data(), rays.size()}, answers.data(), alone, standard);
  EXPECT_LT(2 * together.unoccluded.node_tests, alone.unoccluded.node_tests);
}

}  // namespace
}  // namespace umbrix::detail
