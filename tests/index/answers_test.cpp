// SPDX-License-Identifier: Apache-2.0
// Whatever stands in the lists, answers are those of testing every triangle.
#include <gtest/gtest.h>

#include "index/primitive_index.h"
#include "kernels/kernel.h"
#include "small_scene.h"
#include "umbrix/umbrix.h"

namespace umbrix::detail {
namespace {

/// Anywhere, at corners and at edges, with ends on what they meet; some along an axis, some from far off.
std::vector<Ray> hard_rays(const std::vector<Triangle>& triangles, std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto pick = [&] { return triangles[random() % triangles.size()]; };
  std::vector<Ray> result;
  for (std::size_t i = 0; i < count; ++i) {
    const auto kind = random() % 6;
    Vec3 from = 2.0f * random_point(random), to = 2.0f * random_point(random);
    if (kind == 1) to = pick().v[0];
    if (kind == 2) to = 0.5f * (pick().v[0] + pick().v[1]);
    if (kind == 3) from = pick().v[1];
    if (kind == 4) to.x = from.x;
    if (kind == 5) from = 30.0f * from;
    const Vec3 d = to - from;
    result.push_back({{from.x, from.y, from.z}, 0, {d.x, d.y, d.z}, random() % 3 == 0 ? INFINITY : 1.0f});
  }
  return result;
}

std::vector<std::uint8_t> answers(const char* kernel, const SceneView& scene, const std::vector<Ray>& rays) {
  KernelId id;
  EXPECT_TRUE(find_kernel(kernel, id).ok());
  std::vector<std::uint8_t> out(rays.size());
  QueryOptions options;
  options.kernel = id;
  kernel_at(id).entry_points().occluded(scene, {rays.data(), rays.size()}, out.data(), options);
  return out;
}

class IndexAnswers : public testing::Test {
 protected:
  void TearDown() override { EXPECT_TRUE(use_simd_target(nullptr).ok()); }
};

TEST_F(IndexAnswers, DoNotDependOnTheLists) {
  std::uint32_t seed = 10;
  for (const float size : {0.02f, 0.2f, 1.0f}) {
    const SmallScene scene(random_soup(400, size, ++seed));
    const std::vector<Ray> rays = hard_rays(scene.triangles, 3000, ++seed);
    const std::vector<std::uint8_t> truth = answers("brute", scene.view(), rays);
    for (const std::uint32_t per_node : {1u, 3u, kBlockLanes}) {
      // Any triangle at any node, not only what would help.
      std::mt19937 random(++seed);
      std::vector<Placement> placements;
      for (const std::uint32_t node : scene.inner_nodes())
        for (std::uint32_t i = 0; i < per_node; ++i)
          placements.push_back({node, static_cast<std::uint32_t>(random() % scene.triangles.size())});
      const PrimitiveIndex index(scene.tree, scene.triangles.data(), placements);
      for (std::size_t t = 0; t < simd_target_count(); ++t) {
        SCOPED_TRACE(simd_target_name(t));
        ASSERT_TRUE(use_simd_target(simd_target_name(t)).ok());
        EXPECT_EQ(answers("indexed", scene.view(&index), rays), truth);
      }
    }
  }
}

TEST_F(IndexAnswers, DoNotDependOnPreparation) {
  const std::vector<Triangle> triangles = random_soup(3000, 0.2f, 30);
  Scene scene;
  MeshView mesh;
  mesh.vertices = &triangles[0].v[0].x;
  mesh.vertex_count = 3 * triangles.size();
  mesh.triangle_count = triangles.size();
  ASSERT_TRUE(scene.add(mesh).ok());
  ASSERT_TRUE(scene.commit().ok());
  const std::vector<Ray> seen = rays_to_light(6000, Vec3(2, 2, 2), 31);
  std::vector<Ray> rays = hard_rays(triangles, 5000, 32);
  rays.insert(rays.end(), seen.begin(), seen.begin() + 1000);
  std::vector<std::uint8_t> truth(rays.size()), out(rays.size());
  std::vector<Primitive> skip(rays.size());
  for (std::uint32_t i = 0; i < skip.size(); ++i) skip[i] = {0, i % 3000};
  QueryOptions options;
  options.skip = skip.data();
  Training training;
  training.rays = {seen.data(), seen.size()};
  training.skip = skip.data();
  for (const char* const name : {"standard", "indexed", "indexed-paper"}) {
    SCOPED_TRACE(name);
    ASSERT_TRUE(find_kernel(name, options.kernel).ok());
    if (std::string(name) == "standard") {
      scene.occluded({rays.data(), rays.size()}, truth.data(), options);
      continue;
    }
    for (const Training& how : {Training(), training}) {
      scene.occluded({rays.data(), rays.size()}, out.data(), options);
      EXPECT_EQ(out, truth);
      ASSERT_TRUE(scene.prepare(options.kernel, how).ok());
      OcclusionCounts counts;
      scene.occluded({rays.data(), rays.size()}, out.data(), counts, options);
      EXPECT_EQ(out, truth);
      if (how.rays.count != 0 && std::string(name) == "indexed") {
        EXPECT_GT(counts.occluded.index_tests, 0u);
        EXPECT_LE(counts.occluded.index_tests, counts.occluded.primitive_tests);
      }
    }
  }
}

}  // namespace
}  // namespace umbrix::detail
