// SPDX-License-Identifier: Apache-2.0
#include "index/primitive_index.h"

#include <gtest/gtest.h>

#include <map>

#include "index/cells.h"
#include "small_scene.h"

namespace umbrix::detail {
namespace {

/// Placements of random triangles on every third inner node, in no order.
std::vector<Placement> scattered(const SmallScene& scene, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<Placement> result;
  for (const std::uint32_t node : scene.inner_nodes())
    for (std::uint32_t i = 0; node % 3 == 0 && i <= node % 8; ++i)
      result.push_back({node, static_cast<std::uint32_t>(random() % scene.triangles.size())});
  std::shuffle(result.begin(), result.end(), random);
  return result;
}

TEST(PrimitiveIndex, FindsEachListByItsNode) {
  const SmallScene scene(random_soup(3000, 0.1f, 1));
  const std::vector<Placement> placements = scattered(scene, 2);
  std::map<std::uint32_t, std::vector<std::uint32_t>> expected;
  for (const Placement& p : placements) expected[p.node].push_back(p.triangle);
  ASSERT_GT(expected.size(), 100u);

  const PrimitiveIndex index(scene.tree, scene.triangles.data(), placements);
  EXPECT_EQ(index.lists().size(), expected.size());
  EXPECT_GE(index.bytes(), expected.size() * sizeof(Block));
  for (std::uint32_t node = 0; node < scene.tree.nodes.size(); ++node) {
    const auto found = expected.find(node);
    ASSERT_EQ(index.has_list()[node], found != expected.end());
    if (found == expected.end()) continue;
    const Block& list = index.list(node);
    EXPECT_TRUE(index.holds(&list));
    EXPECT_EQ(std::vector<std::uint32_t>(list.id, list.id + list.count), found->second);
  }
  EXPECT_FALSE(index.holds(scene.tree.blocks.data()));
  EXPECT_FALSE(index.holds(nullptr));
}

TEST(PrimitiveIndex, KeepsNoMoreThanABlockANode) {
  const SmallScene scene(random_soup(200, 0.1f, 3));
  std::vector<Placement> placements;
  for (std::uint32_t id = 0; id < 20; ++id) placements.push_back({0, id});
  const PrimitiveIndex index(scene.tree, scene.triangles.data(), placements);
  ASSERT_EQ(index.lists().size(), 1u);
  EXPECT_EQ(index.list(0).count, kBlockLanes);
  EXPECT_EQ(index.list(0).id[7], 7u);
}

TEST(PrimitiveIndex, IsEmptyWithoutPlacements) {
  const SmallScene scene(random_soup(200, 0.1f, 3));
  const PrimitiveIndex index(scene.tree, scene.triangles.data(), {});
  EXPECT_TRUE(index.empty());
  EXPECT_EQ(index.bytes(), 0u);
  EXPECT_FALSE(index.holds(nullptr));
}

/// The filter's error bounds rest on it, wherever the triangles are.
TEST(PrimitiveIndex, ReachesFromTheWholeCellToItsTriangles) {
  std::vector<Triangle> triangles = random_soup(2000, 0.1f, 4);
  for (Triangle& t : triangles)
    for (Vec3& v : t.v) v = 1000.0f * v + Vec3(500, -200, 30);
  const SmallScene scene(std::move(triangles));
  const PrimitiveIndex index(scene.tree, scene.triangles.data(), scattered(scene, 5));
  for (const std::uint32_t node : index.nodes()) {
    const Box cell = cell_of(scene.tree, node, scene.tree.root);
    const Block& list = index.list(node);
    for (std::uint32_t corner = 0; corner < 8; ++corner)
      for (std::uint32_t lane = 0; lane < list.count; ++lane) {
        DVec3 way;
        for (int k = 0; k < 3; ++k)
          way[k] = static_cast<double>((corner >> k & 1u) != 0 ? cell.upper[k] : cell.lower[k]) -
                   static_cast<double>(list.v0[k][lane]);
        EXPECT_LT(glm::length(way), static_cast<double>(list.reach));
      }
  }
}

TEST(Cells, KnowWhoIsAboveWhom) {
  const SmallScene scene(random_soup(500, 0.1f, 6));
  for (const std::uint32_t node : scene.inner_nodes()) {
    const std::uint32_t low = scene.tree.nodes[node].low_child();
    EXPECT_TRUE(is_within_subtree(scene.tree, 0, node));
    EXPECT_TRUE(is_within_subtree(scene.tree, node, node));
    EXPECT_TRUE(is_within_subtree(scene.tree, node, low));
    EXPECT_TRUE(is_within_subtree(scene.tree, node, low + 1));
    EXPECT_FALSE(is_within_subtree(scene.tree, low, node));
    EXPECT_FALSE(is_within_subtree(scene.tree, low, low + 1));
    EXPECT_FALSE(is_within_subtree(scene.tree, low + 1, low));
  }
}

}  // namespace
}  // namespace umbrix::detail
