// SPDX-License-Identifier: Apache-2.0
#include "index/select_learned.h"

#include <gtest/gtest.h>

#include <map>

#include "index/cells.h"
#include "kernels/indexed.h"
#include "small_scene.h"

namespace umbrix::detail {
namespace {

/// What is on the ground, and above it one great triangle.
constexpr std::uint32_t kOnTheGround = 3000;
std::vector<Triangle> covered_ground() {
  std::vector<Triangle> result = random_soup(kOnTheGround, 0.05f, 1);
  for (Triangle& t : result)
    for (Vec3& v : t.v) v.z *= 0.5f;
  result.push_back({{Vec3(-20, -20, 2), Vec3(20, -20, 2.5f), Vec3(0, 40, 2.25f)}});
  return result;
}

/// From among what is on the ground upwards, beyond the cover or up to just below it.
std::vector<Ray> upwards(std::size_t count, float tmax, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<Ray> result;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 from = random_point(random) * Vec3(0.9f, 0.9f, 0.4f), d = Vec3(0, 0, 1) + 0.3f * random_point(random);
    result.push_back({{from.x, from.y, from.z}, 0, {d.x, d.y, d.z}, tmax});
  }
  return result;
}

std::vector<Ending> trace(const SmallScene& scene, const std::vector<Ray>& rays, const SideTable* side = nullptr) {
  return find_endings(scene.view(side), {rays.data(), rays.size()}, nullptr, nullptr);
}

std::vector<Placement> learn(const SmallScene& scene, const std::vector<Ray>& rays,
                             const LearnedOptions& options = {}) {
  std::vector<std::uint32_t> blockers;
  for (const Ending& ending : trace(scene, rays)) blockers.push_back(ending.blocker);
  return select_learned(scene.tree, {{rays.data(), rays.size()}, blockers.data()}, options);
}

std::uint64_t tests(const std::vector<Ending>& endings) {
  std::uint64_t sum = 0;
  for (const Ending& ending : endings) sum += ending.node_tests + ending.primitive_tests;
  return sum;
}

TEST(SelectLearned, FindsTheTriangleThatCoversAll) {
  const SmallScene scene(covered_ground());
  const std::vector<Placement> placements = learn(scene, upwards(4000, 9, 1));
  const auto is_cover = [](const Placement& p) { return p.triangle == kOnTheGround; };
  ASSERT_TRUE(std::any_of(placements.begin(), placements.end(), is_cover));

  // Rays it has not seen are spared most of their way.
  const PrimitiveIndex index(scene.tree, scene.triangles.data(), placements);
  const std::vector<Ray> others = upwards(4000, 9, 2);
  const std::vector<Ending> without = trace(scene, others), with = trace(scene, others, &index);
  EXPECT_LT(2 * tests(with), tests(without));
  EXPECT_GT(std::count_if(with.begin(), with.end(), [](const Ending& e) { return e.is_indexed; }), 3000);
}

TEST(SelectLearned, PlacesNothingThatDoesNotPay) {
  const SmallScene scene(covered_ground());
  EXPECT_TRUE(learn(scene, {}).empty());
  // Up to just below the cover few are blocked, and each by another triangle.
  std::vector<Ray> open;
  for (const Ray& ray : upwards(4000, 1.2f, 3))
    if (trace(scene, {ray})[0].blocker == Primitive::kNone) open.push_back(ray);
  ASSERT_GT(open.size(), 1000u);
  EXPECT_TRUE(learn(scene, open).empty());
  // One blocked ray among thousands is below the two percent.
  for (const Ray& ray : upwards(4, 9, 4)) open.push_back(ray);
  EXPECT_TRUE(learn(scene, open).empty());
}

TEST(SelectLearned, KeepsItsLimits) {
  const SmallScene scene(random_soup(3000, 0.2f, 5));
  const std::vector<Ray> rays = rays_to_light(8000, Vec3(2, 2, 2), 6);
  for (const std::uint32_t per_node : {1u, 2u, 8u}) {
    LearnedOptions options;
    options.per_node = per_node;
    const std::vector<Placement> placements = learn(scene, rays, options);
    ASSERT_GT(placements.size(), 10u);
    std::map<std::uint32_t, std::uint32_t> at_node;
    for (const Placement& a : placements) {
      EXPECT_LE(++at_node[a.node], per_node);
      EXPECT_FALSE(scene.tree.nodes[a.node].is_leaf());
      for (const Placement& b : placements) {
        if (&a == &b || a.triangle != b.triangle) continue;
        EXPECT_FALSE(is_within_subtree(scene.tree, a.node, b.node)) << "twice on one path";
      }
    }
  }
}

TEST(SelectLearned, IsDeterministic) {
  const SmallScene scene(covered_ground());
  const std::vector<Ray> rays = upwards(3000, 9, 7);
  const std::vector<Placement> first = learn(scene, rays), second = learn(scene, rays);
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].node, second[i].node);
    EXPECT_EQ(first[i].triangle, second[i].triangle);
  }
}

}  // namespace
}  // namespace umbrix::detail
