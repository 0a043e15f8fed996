// SPDX-License-Identifier: Apache-2.0
//
// Rays in bundles from points, as to lights of some size, which the default kernel answers together: each must have the
// answer that it has alone.
#include <gtest/gtest.h>

#include "bundles.h"
#include "two_meshes.h"

namespace umbrix::detail {
namespace {

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

TEST(Shafts, LightsOfAnySize) {
  const TwoMeshes two;
  for (const float reach : {1e-6f, 0.01f, 0.5f, 1.0f, 3.0f}) {
    SCOPED_TRACE(reach);
    expect_right(two.scene, bundles(200, 16, 0.02f, 7, reach));
  }
}

TEST(Shafts, TinyScenesAndDenormals) {
  for (const float scale : {1e-3f, 1e-15f, 1e-30f}) {
    SCOPED_TRACE(scale);
    std::vector<Triangle> soup = random_soup(300, 0.2f, 1);
    for (Triangle& triangle : soup)
      for (Vec3& v : triangle.v) v *= scale;
    Scene scene;
    ASSERT_TRUE(scene.add(view_of(soup)).ok());
    ASSERT_TRUE(scene.commit().ok());
    std::vector<Ray> rays = bundles(200, 16, 0.02f, 8, 1.0f);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      for (float& x : rays[i].origin) x *= scale;
      if (i % 3 != 0)
        for (float& x : rays[i].direction) x *= scale;
      else
        rays[i].tmax *= scale;
      if (i % 50 == 0) rays[i].tmin = 1e-40f;
      if (i % 64 == 0) rays[i].direction[0] = 1e-41f;
    }
    expect_right(scene, rays);
  }
}

TEST(Shafts, IntervalsAroundAHit) {
  const std::vector<Triangle> soup = random_soup(3000, 0.05f, 9);
  Scene scene;
  ASSERT_TRUE(scene.add(view_of(soup)).ok());
  ASSERT_TRUE(scene.commit().ok());
  std::vector<Ray> rays = bundles(200, 16, 0.02f, 10, 2);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    Hit hit;
    if (!scene.closest(rays[i], hit)) continue;
    rays[i].tmin = hit.t * (i % 2 == 0 ? 1 - 1e-6f : 1 + 1e-6f);
    rays[i].tmax = hit.t * (1 + 3e-6f);
  }
  expect_right(scene, rays);
}

TEST(Shafts, MoreThanOneBatch) {
  const TwoMeshes two;
  const std::vector<Ray> rays = bundles(3000, 16, 0.02f, 6);
  std::vector<std::uint8_t> answers(rays.size());
  two.scene.occluded(RaySpan{rays.data(), rays.size()}, answers.data());
  for (std::size_t i = 0; i < rays.size(); ++i) ASSERT_EQ(answers[i] != 0, two.scene.occluded(rays[i])) << i;
}

/// So many triangles, 82 bytes each, that caches do not hold them: bundles take turns then.
TEST(Shafts, LargeScenes) {
  const std::vector<Triangle> soup = random_soup(2000000, 0.004f, 9);
  Scene scene;
  ASSERT_TRUE(scene.add(view_of(soup)).ok());
  ASSERT_TRUE(scene.commit().ok());
  const std::vector<Ray> rays = bundles(400, 16, 0.5f, 11, 2);
  std::vector<std::uint8_t> answers(rays.size());
  scene.occluded(RaySpan{rays.data(), rays.size()}, answers.data());
  std::size_t occluded = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ASSERT_EQ(answers[i] != 0, scene.occluded(rays[i])) << i;
    occluded += answers[i];
  }
  EXPECT_GT(occluded, rays.size() / 4);
  EXPECT_LT(occluded, rays.size());
}

}  // namespace
}  // namespace umbrix::detail
