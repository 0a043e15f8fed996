// SPDX-License-Identifier: Apache-2.0
//
// Rays in bundles from points, as to lights of some size, which the default kernel answers together: each must have the
// answer that it has alone.
#include <cmath>
#include <cstring>
#include <limits>

#include "two_meshes.h"

namespace umbrix::detail {
namespace {

/// `each` rays from each of neighbouring points to a box around the light.
std::vector<Ray> bundles(std::size_t points, std::size_t each, float spread, std::uint32_t seed) {
  std::mt19937 random(seed);
  const Vec3 light(0.3f, 0.9f, -0.2f);
  std::vector<Ray> rays;
  Vec3 middle(0);
  for (std::size_t i = 0; i < points; ++i) {
    if (i % 40 == 0) middle = random_point(random);
    const Vec3 from = middle + spread * random_point(random);
    for (std::size_t k = 0; k < each; ++k) {
      const Vec3 d = light + 0.1f * random_point(random) - from;
      rays.push_back({{from.x, from.y, from.z}, 0, {d.x, d.y, d.z}, 1});
    }
  }
  return rays;
}

std::vector<Ray> some_bundles() { return bundles(300, 16, 0.05f, 5); }

TEST(Shafts, BundlesOfAnySize) {
  const TwoMeshes two;
  for (const std::size_t each : {2u, 6u, 8u, 15u, 16u, 17u, 40u}) {
    SCOPED_TRACE(each);
    expect_right(two.scene, bundles(2000 / each, each, 0.05f, 3));
  }
}

TEST(Shafts, PointsTogetherAndApart) {
  const TwoMeshes two;
  for (const float spread : {0.0f, 1e-6f, 1e-3f, 1.0f}) {
    SCOPED_TRACE(spread);
    expect_right(two.scene, bundles(200, 16, spread, 4));
  }
}

TEST(Shafts, MoreThanOneBatch) {
  const TwoMeshes two;
  const std::vector<Ray> rays = bundles(3000, 16, 0.02f, 6);
  std::vector<std::uint8_t> answers(rays.size());
  two.scene.occluded(RaySpan{rays.data(), rays.size()}, answers.data());
  for (std::size_t i = 0; i < rays.size(); ++i) ASSERT_EQ(answers[i] != 0, two.scene.occluded(rays[i])) << i;
}

TEST(Shafts, MasksHold) {
  const TwoMeshes two;
  for (const std::uint32_t mask : {1u, 2u, 3u}) {
    QueryOptions options;
    options.mask = mask;
    expect_right(two.scene, some_bundles(), options);
  }
}

TEST(Shafts, SkippedTrianglesAreNotThere) {
  const TwoMeshes two;
  const std::vector<Ray> rays = some_bundles();
  std::vector<Primitive> skip(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    Hit hit;
    if (two.scene.closest(rays[i], hit)) skip[i] = hit.primitive;
  }
  QueryOptions options;
  options.skip = skip.data();
  expect_right(two.scene, rays, options);
}

TEST(Shafts, OpacityIsAsked) {
  OpacityTest half;
  half.opaque = [](const void*, std::uint32_t triangle, float u, float v) { return triangle % 2 == 0 || u < v; };
  expect_right(TwoMeshes(half).scene, some_bundles());
}

TEST(Shafts, AnyIntervalsAndLengths) {
  const TwoMeshes two;
  std::vector<Ray> rays = some_bundles();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const float length = std::ldexp(1.0f, static_cast<int>(i % 41) - 20);
    for (float& x : rays[i].direction) x *= length;
    rays[i].tmax = 1 / length;
    if (i % 3 == 0) rays[i].tmin = 0.25f / length;
    if (i % 97 == 0) rays[i].tmin = -0.25f / length;
  }
  expect_right(two.scene, rays);
}

TEST(Shafts, SomeRaysMayBeOdd) {
  const TwoMeshes two;
  std::vector<Ray> rays = some_bundles();
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

TEST(Shafts, RaysMayLieInLargerThings) {
  const TwoMeshes two;
  struct Thing {
    Ray ray;
    char more[20];
  };
  const std::vector<Ray> rays = some_bundles();
  std::vector<Thing> things(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) things[i].ray = rays[i];
  std::vector<std::uint8_t> together(rays.size()), apart(rays.size());
  two.scene.occluded(RaySpan{rays.data(), rays.size()}, together.data());
  two.scene.occluded(RaySpan{&things[0].ray, things.size(), sizeof(Thing)}, apart.data());
  EXPECT_EQ(together, apart);
}

}  // namespace
}  // namespace umbrix::detail
