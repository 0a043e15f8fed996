// SPDX-License-Identifier: Apache-2.0
//
// Many rays to one light, which the default kernel answers together: each must have the answer that it has alone.
#include <gtest/gtest.h>

#include "two_meshes.h"

namespace umbrix::detail {
namespace {

constexpr std::size_t kRays = 3000;

std::vector<Ray> some_rays() { return rays_to_light(kRays, Vec3(0.3f, 0.9f, -0.2f), 5); }

TEST(LightView, LightsByTurnsAreAnsweredOtherwise) {
  const TwoMeshes two;
  std::vector<Ray> rays = some_rays();
  const std::vector<Ray> others = rays_to_light(kRays, Vec3(-0.9f, 0.1f, 0.4f), 6);
  for (std::size_t i = 0; i < rays.size(); i += 2) rays[i] = others[i];
  expect_right(two.scene, rays);
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
