// SPDX-License-Identifier: Apache-2.0
//
// Many rays to one light, which the default kernel answers together: each must have the answer that it has alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "two_meshes.h"

namespace umbrix::detail {
namespace {

constexpr std::size_t kRays = 3000;
const Vec3 kLight(0.1f, 0.2f, 0.3f);

std::vector<Ray> some_rays() { return rays_to_light(kRays, Vec3(0.3f, 0.9f, -0.2f), 5); }

TEST(LightView, LightsByTurnsAreAnsweredOtherwise) {
  const TwoMeshes two;
  std::vector<Ray> rays = some_rays();
  const std::vector<Ray> others = rays_to_light(kRays, Vec3(-0.9f, 0.1f, 0.4f), 6);
  for (std::size_t i = 0; i < rays.size(); i += 2) rays[i] = others[i];
  expect_right(two.scene, rays);
}

/// Each has the answer that it has alone: to test every triangle for so many would take long.
void expect_as_alone(const std::vector<Ray>& rays) {
  const TwoMeshes two;
  std::vector<std::uint8_t> alone(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) alone[i] = two.scene.occluded(rays[i]) ? 1 : 0;
  expect_answers(two.scene, rays, alone);
}

/// Where a batch of an ordered call has ended, and rays enough for two of them, or three.
constexpr std::size_t kBatchEnds = 140000, kTwoBatches = 270000, kThreeBatches = 400000;

TEST(LightView, ManyRaysFromEverywhereAreSorted) {
  // So many that they come in an order that the light cannot use, and are brought into one.
  for (const std::size_t count : {10000u, 100000u}) expect_as_alone(rays_to_light(count, kLight, 9));
}

/// The rays from a batch's end on are others.
std::vector<Ray> walls_then(const std::vector<Ray>& others) {
  std::vector<Ray> rays = rays_from_walls(others.size(), kLight);
  std::copy(others.begin() + kBatchEnds, others.end(), rays.begin() + kBatchEnds);
  return rays;
}

TEST(LightView, VeryManyRaysComeInBatches) { expect_as_alone(rays_from_walls(kTwoBatches, kLight)); }

TEST(LightView, OrderMayEndAfterABatch) { expect_as_alone(walls_then(rays_to_light(kThreeBatches, kLight, 10))); }

TEST(LightView, TheLightMayChangeAfterABatch) {
  expect_as_alone(walls_then(rays_to_light(kTwoBatches, Vec3(-0.9f, 0.1f, 0.4f), 11)));
}

TEST(LightView, TrianglesMayBeTinyAndNextToTheLight) {
  // One over the triple product of their vertices is no float; a large one gives the scene its size.
  constexpr float kEdge = 0x1p-42f, kDepth = 0x1p-45f, kStart = 0x1p-28f;
  const std::vector<Triangle> triangles{{{Vec3(0, -kEdge, -kDepth), Vec3(kEdge, 0, -kDepth), Vec3(0, kEdge, -kDepth)}},
                                        {{Vec3(0, 0, 1), Vec3(1, 0, 1), Vec3(0, 1, 1)}}};
  Scene scene;
  ASSERT_TRUE(scene.add(view_of(triangles)).ok());
  ASSERT_TRUE(scene.commit().ok());
  std::vector<Ray> rays;
  const auto place = [](int k) { return kStart * (static_cast<float>(k) / 8 - 1); };
  for (int i = 0; i < 256; ++i) {
    const float x = place(i % 16), y = place(i / 16);
    rays.push_back({{x, y, -1.5f * kStart}, 0, {-x, -y, 1.5f * kStart}, 1});
  }
  expect_right(scene, rays);
}

TEST(LightView, OneWalkServesAllRays) {
  const TwoMeshes two;
  QueryOptions standard;
  ASSERT_TRUE(find_kernel("standard", standard.kernel).ok());
  for (const std::vector<Ray>& rays : {some_rays(), rays_to_light(30000, kLight, 9)}) {
    std::vector<std::uint8_t> answers(rays.size());
    OcclusionCounts together, alone;
    two.scene.occluded(RaySpan{rays.data(), rays.size()}, answers.data(), together);
    two.scene.occluded(RaySpan{rays.data(), rays.size()}, answers.data(), alone, standard);
    EXPECT_LT(2 * together.unoccluded.node_tests, alone.unoccluded.node_tests) << rays.size() << " rays";
  }
}

}  // namespace
}  // namespace umbrix::detail
