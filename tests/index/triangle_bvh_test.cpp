// SPDX-License-Identifier: Apache-2.0
#include "index/triangle_bvh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <string>

#include "small_scene.h"
#include "umbrix/executor.h"

namespace umbrix::detail {
namespace {

/// The unit normal, but of triangles so small that nobody needs it, and the longest edge.
void expect_measures(const TriangleRows& rows, std::uint32_t i, const Triangle& t) {
  const DVec3 a = t.v[0], b = t.v[1], c = t.v[2], n = glm::cross(b - a, c - a);
  const double area = glm::length(n);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(rows.normal[k][i], area > 0x1p-200 ? n[k] / area : 0, 1e-7);
  const double longest = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
  EXPECT_GE(rows.longest[i], longest);
  EXPECT_LE(rows.longest[i], longest * (1 + 1e-5));
}

/// Adds the ids below a node, whose triangles must be within the box.
void collect(const TriangleBvh& bvh, const std::vector<Triangle>& triangles, std::uint32_t index, const Box& around,
             std::vector<std::uint32_t>& ids) {
  const BvhNode& node = bvh.node(index);
  for (std::uint32_t lane = 0; lane < kBvhWidth; ++lane) {
    Box box;
    for (int k = 0; k < 3; ++k) {
      box.lower[k] = node.lower[k][lane];
      box.upper[k] = node.upper[k][lane];
    }
    if (box.empty()) continue;
    for (int k = 0; k < 3; ++k) ASSERT_TRUE(around.lower[k] <= box.lower[k] && box.upper[k] <= around.upper[k]);
    if ((node.child[lane] & BvhNode::kLeaf) == 0) {
      collect(bvh, triangles, node.child[lane], box, ids);
      continue;
    }
    const TriangleRows& rows = bvh.rows(node.child[lane] & ~BvhNode::kLeaf);
    ASSERT_TRUE(rows.count >= 1 && rows.count <= kRowLanes);
    for (std::uint32_t i = 0; i < rows.count; ++i) {
      ids.push_back(rows.id[i]);
      for (int vertex = 0; vertex < 3; ++vertex) {
        for (int k = 0; k < 3; ++k) {
          const float x = rows.v[vertex][k][i];
          ASSERT_EQ(x, triangles[rows.id[i]].v[vertex][k]);
          ASSERT_TRUE(box.lower[k] <= x && x <= box.upper[k]);
        }
      }
      expect_measures(rows, i, triangles[rows.id[i]]);
    }
  }
}

constexpr float kEps = 0x1p-20f;

Box everywhere() {
  Box box;
  box.lower = Vec3(-1e9f);
  box.upper = Vec3(1e9f);
  return box;
}

TEST(TriangleBvh, HoldsEachTriangleOnceWithinItsBoxes) {
  for (const std::size_t count : {1u, 2u, 16u, 17u, 100u, 20000u}) {
    SCOPED_TRACE(count);
    std::vector<Triangle> triangles = random_soup(count, 0.1f, 7);
    std::vector<std::uint32_t> kept;
    for (std::uint32_t i = 0; i < count; ++i)
      if (i % 5 != 3 || count < 5) kept.push_back(i);
    const TriangleBvh bvh(triangles.data(), kept.data(), kept.size(), 0, kEps, nullptr);
    std::vector<std::uint32_t> ids;
    collect(bvh, triangles, 0, everywhere(), ids);
    std::sort(ids.begin(), ids.end());
    EXPECT_EQ(ids, kept);
  }
}

TEST(TriangleBvh, TakesTrianglesThatAreAllTheSame) {
  const std::vector<Triangle> triangles(5000, random_soup(1, 1, 1)[0]);
  const SmallScene scene(triangles);
  const TriangleBvh bvh(triangles.data(), scene.kept.data(), scene.kept.size(), 0, kEps, nullptr);
  std::vector<std::uint32_t> ids;
  collect(bvh, triangles, 0, everywhere(), ids);
  EXPECT_EQ(ids.size(), triangles.size());
}

/// Nodes above the deepest leaf.
std::uint32_t depth_below(const TriangleBvh& bvh, std::uint32_t index) {
  std::uint32_t depth = 0;
  for (const std::uint32_t child : bvh.node(index).child)
    if ((child & BvhNode::kLeaf) == 0) depth = std::max(depth, depth_below(bvh, child));
  return depth + 1;
}

// Each is half of the one before: every cut that pays takes off the largest alone.
TEST(TriangleBvh, HasADeepestLeaf) {
  std::vector<Triangle> triangles;
  float size = 0.5f;
  for (int i = 0; i < 120; ++i, size *= 0.5f)
    for (int copy = 0; copy < 20; ++copy)
      triangles.push_back({{Vec3(size, size, size), Vec3(size, 2 * size, size), Vec3(2 * size, size, size)}});
  const SmallScene scene(triangles);
  const TriangleBvh bvh(triangles.data(), scene.kept.data(), scene.kept.size(), 0, kEps, nullptr);
  EXPECT_LE(depth_below(bvh, 0), kMaxBvhDepth);
  std::vector<std::uint32_t> ids;
  collect(bvh, triangles, 0, everywhere(), ids);
  EXPECT_EQ(ids.size(), triangles.size());
}

TEST(TriangleBvh, DoesNotDependOnTheExecutor) {
  const std::vector<Triangle> triangles = random_soup(30000, 0.05f, 3);
  const SmallScene scene(triangles);
  const Executor backwards{[](void*, std::size_t count, void (*body)(void*, std::size_t), void* data) {
                             for (std::size_t i = count; i > 0; --i) body(data, i - 1);
                           },
                           nullptr};
  const TriangleBvh one(triangles.data(), scene.kept.data(), scene.kept.size(), 0, kEps, &backwards);
  const TriangleBvh other(triangles.data(), scene.kept.data(), scene.kept.size(), 0, kEps, nullptr);
  std::vector<std::uint32_t> a, b;
  collect(one, triangles, 0, everywhere(), a);
  collect(other, triangles, 0, everywhere(), b);
  EXPECT_EQ(a, b);
}

TEST(TriangleBvh, IsEmptyWithoutTriangles) { EXPECT_TRUE(TriangleBvh(nullptr, nullptr, 0, 0, kEps, nullptr).empty()); }

}  // namespace
}  // namespace umbrix::detail
