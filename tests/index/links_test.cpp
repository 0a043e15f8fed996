// SPDX-License-Identifier: Apache-2.0
//
// A link names the smallest node whose cell covers the whole outer side of a face, whoever makes it and when.
#include "index/links.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "index/cells.h"
#include "kernels/kernel.h"
#include "small_scene.h"
#include "umbrix/umbrix.h"

namespace umbrix::detail {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Squares along the axes, at places of a grid: planes of the tree meet at edges and corners of many cells.
std::vector<Triangle> room(std::size_t squares, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<Triangle> result;
  for (std::size_t i = 0; i < squares; ++i) {
    const int axis = static_cast<int>(random() % 3), u = (axis + 1) % 3, v = (axis + 2) % 3;
    Vec3 corner;
    for (int k = 0; k < 3; ++k) corner[k] = static_cast<float>(random() % 9) / 8 - 0.5f;
    Vec3 along = corner, across = corner, opposite = corner;
    along[u] += 0.125f;
    across[v] += 0.25f;
    opposite[u] += 0.125f;
    opposite[v] += 0.25f;
    result.push_back({{corner, along, opposite}});
    result.push_back({{corner, opposite, across}});
  }
  return result;
}

/// Soups whose cells are thin and thick, and rooms.
std::vector<std::vector<Triangle>> geometries() {
  return {random_soup(60, 0.05f, 61), random_soup(60, 0.8f, 62), room(40, 63), room(120, 64), random_soup(1, 0.5f, 65)};
}

/// The cells of all nodes, those on the root's box without end.
std::vector<Box> all_cells(const Tree& tree) {
  std::vector<Box> cells(tree.nodes.size());
  cells[0] = {Vec3(-kInfinity), Vec3(kInfinity)};
  std::vector<std::uint32_t> open{0};
  while (!open.empty()) {
    const std::uint32_t at = open.back();
    open.pop_back();
    const Node& node = tree.nodes[at];
    if (node.is_leaf()) continue;
    for (const std::uint32_t side : {0u, 1u}) {
      cells[node.low_child() + side] = half_cell(cells[at], node, side != 0);
      open.push_back(node.low_child() + side);
    }
  }
  return cells;
}

std::vector<std::uint32_t> leaf_nodes(const Tree& tree) {
  std::vector<std::uint32_t> leaves;
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i)
    if (i != 1 && tree.nodes[i].is_leaf()) leaves.push_back(i);  // 1 is nobody's child
  return leaves;
}

/// Where a face of a cell is.
float place(const Box& cell, std::uint32_t face) {
  const int axis = static_cast<int>(face % 3);
  return face < 3 ? cell.lower[axis] : cell.upper[axis];
}

/// Does the cell cover what lies just outside of a face of another?
bool covers(const Box& cell, const Box& other, std::uint32_t face) {
  const int normal = static_cast<int>(face % 3);
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == normal) continue;
    if (cell.lower[axis] > other.lower[axis] || cell.upper[axis] < other.upper[axis]) return false;
  }
  const float at = place(other, face);
  return face < 3 ? cell.lower[normal] < at && at <= cell.upper[normal]
                  : cell.lower[normal] <= at && at < cell.upper[normal];
}

std::uint32_t target_node(const Links& links, Link link) {
  return link.is_leaf() ? links.leaf(link.target()).node : link.target();
}

constexpr std::uint32_t kNowhere = 0xFFFFFFFFu;

/// The node that each face of a leaf leads to; kNowhere if it is not known or the face is on the root's box.
std::vector<std::uint32_t> targets(const Links& links, std::uint32_t leaf) {
  std::vector<std::uint32_t> result(kFaces, kNowhere);
  const std::uint32_t record = links.record_of(leaf);
  if (record == 0) return result;
  const LinkedLeaf& here = links.leaf(record);
  for (std::uint32_t face = 0; face < kFaces; ++face) {
    if (std::abs(here.faces[face]) == kInfinity) continue;
    const Link link = links.follow(here, face);
    if (link.is_set()) result[face] = target_node(links, link);
  }
  return result;
}

TEST(Links, LeadToTheSmallestNodeThatCoversTheFace) {
  for (const std::vector<Triangle>& triangles : geometries()) {
    const SmallScene scene(triangles);
    const Tree& tree = scene.tree;
    const std::vector<Box> cells = all_cells(tree);
    Links links(tree, LinkBuilder::full);
    links.build_full(nullptr);
    for (const std::uint32_t leaf : leaf_nodes(tree)) {
      const std::vector<std::uint32_t> found = targets(links, leaf);
      for (std::uint32_t face = 0; face < kFaces; ++face) {
        SCOPED_TRACE(testing::Message() << "leaf " << leaf << " face " << face);
        const bool is_outside = std::abs(place(cells[leaf], face)) == kInfinity;
        ASSERT_EQ(found[face] == kNowhere, is_outside);
        if (is_outside) continue;
        ASSERT_TRUE(covers(cells[found[face]], cells[leaf], face));
        // Nodes that cover the face lie one in another, but for a face without width, which two siblings may share.
        for (std::uint32_t node = 0; node < tree.nodes.size(); ++node) {
          if (node == 1 || node == found[face] || !is_within_subtree(tree, found[face], node)) continue;
          ASSERT_FALSE(covers(cells[node], cells[leaf], face)) << found[face] << " is larger than " << node;
        }
      }
    }
  }
}

TEST(Links, AreTheSameHoweverTheyAreMade) {
  for (const std::vector<Triangle>& triangles : geometries()) {
    const SmallScene scene(triangles);
    const Tree& tree = scene.tree;
    const std::vector<std::uint32_t> leaves = leaf_nodes(tree);
    Links full(tree, LinkBuilder::full);
    full.build_full(nullptr);
    EXPECT_EQ(full.leaf_count(), leaves.size());
    const Links lazy(tree, LinkBuilder::lazy);
    EXPECT_EQ(lazy.leaf_count(), 0u);
    for (const std::uint32_t leaf : leaves) ASSERT_EQ(targets(lazy, leaf), targets(full, leaf)) << "leaf " << leaf;
    EXPECT_EQ(lazy.leaf_count(), leaves.size());
    EXPECT_EQ(lazy.bytes(), full.bytes());

    Links reached(tree, LinkBuilder::reached);
    std::vector<bool> touched(tree.nodes.size());
    for (const std::uint32_t leaf : leaves) touched[leaf] = true;
    reached.build_reached({Vec3(0)}, touched);
    for (const std::uint32_t leaf : leaves)
      ASSERT_EQ(targets(reached, leaf), targets(full, leaf)) << "every leaf can be reached: " << leaf;
  }
}

TEST(Links, ReachedOnesAreSomeOfAll) {
  std::mt19937 random(66);
  for (const std::vector<Triangle>& triangles : geometries()) {
    const SmallScene scene(triangles);
    const Tree& tree = scene.tree;
    const std::vector<std::uint32_t> leaves = leaf_nodes(tree);
    Links full(tree, LinkBuilder::full);
    full.build_full(nullptr);
    for (const unsigned percent : {0u, 30u, 80u}) {
      std::vector<bool> touched(tree.nodes.size());
      for (const std::uint32_t leaf : leaves) touched[leaf] = random() % 100 < percent;
      Links reached(tree, LinkBuilder::reached);
      reached.build_reached({Vec3(0), Vec3(5, -5, 5)}, touched);
      EXPECT_EQ(reached.leaf_count(), static_cast<std::size_t>(std::count(touched.begin(), touched.end(), true)));
      for (const std::uint32_t leaf : leaves) {
        const std::vector<std::uint32_t> some = targets(reached, leaf), all = targets(full, leaf);
        for (std::uint32_t face = 0; face < kFaces; ++face) {
          if (some[face] == kNowhere) continue;
          ASSERT_TRUE(touched[leaf]);
          ASSERT_EQ(some[face], all[face]) << "leaf " << leaf << " face " << face;
          ASSERT_TRUE(!tree.nodes[some[face]].is_leaf() || touched[some[face]]);
        }
      }
    }
  }
}

TEST(Links, SeveralThreadsMakeTheSame) {
  const SmallScene scene(random_soup(3000, 0.1f, 67));
  const std::vector<std::uint32_t> leaves = leaf_nodes(scene.tree);
  Links full(scene.tree, LinkBuilder::full);
  full.build_full(nullptr);
  const Links lazy(scene.tree, LinkBuilder::lazy);
  std::vector<std::thread> threads;
  for (std::uint32_t t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      std::vector<std::uint32_t> order = leaves;
      // Two pairs that go the same way, so that they want the same leaf at once.
      std::shuffle(order.begin(), order.end(), std::mt19937(t / 2));
      for (const std::uint32_t leaf : order) EXPECT_EQ(targets(lazy, leaf), targets(full, leaf));
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(lazy.leaf_count(), leaves.size()) << "a leaf that two threads wanted counts once";
  EXPECT_EQ(lazy.bytes(), full.bytes());
}

std::vector<std::uint8_t> answers(const char* kernel, const SceneView& scene, const std::vector<Ray>& rays,
                                  OcclusionCounts& counts) {
  QueryOptions options;
  EXPECT_TRUE(find_kernel(kernel, options.kernel).ok());
  std::vector<std::uint8_t> out(rays.size());
  kernel_at(options.kernel)
      .entry_points()
      .occluded_counted(scene, {rays.data(), rays.size()}, out.data(), options, counts);
  return out;
}

TEST(Links, WhereOneIsMissingTheStackTakesOver) {
  std::mt19937 random(68);
  for (const std::vector<Triangle>& triangles : geometries()) {
    const SmallScene scene(triangles);
    const std::vector<Ray> rays = rays_to_light(2000, Vec3(0.3f, 0.2f, 2), 69);
    OcclusionCounts ignored;
    const std::vector<std::uint8_t> truth = answers("brute", scene.view(), rays, ignored);
    std::uint64_t missing_before = 0;
    for (const unsigned percent : {100u, 60u, 0u}) {
      std::vector<bool> touched(scene.tree.nodes.size());
      for (const std::uint32_t leaf : leaf_nodes(scene.tree)) touched[leaf] = random() % 100 < percent;
      Links links(scene.tree, LinkBuilder::reached);
      links.build_reached({Vec3(0)}, touched);
      OcclusionCounts counts;
      EXPECT_EQ(answers("linked", scene.view(&links), rays, counts), truth);
      const std::uint64_t missing = counts.occluded.links_missing + counts.unoccluded.links_missing;
      if (percent == 100) {
        EXPECT_EQ(missing, 0u);
      } else {
        EXPECT_GE(missing, missing_before);
      }
      missing_before = missing;
    }
    EXPECT_GT(missing_before, 0u);
    const Links lazy(scene.tree, LinkBuilder::lazy);
    OcclusionCounts counts;
    EXPECT_EQ(answers("linked", scene.view(&lazy), rays, counts), truth);
    EXPECT_EQ(counts.occluded.links_missing + counts.unoccluded.links_missing, 0u);
  }
}

}  // namespace
}  // namespace umbrix::detail
