// SPDX-License-Identifier: Apache-2.0
//
// The wide tree holds what the tree holds: each leaf once, in a box around all that the leaf has of its triangles.
#include "index/wide_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <thread>

#include "index/cells.h"
#include "small_scene.h"

namespace umbrix::detail {
namespace {

Box box_of(const WideNode& node, std::uint32_t lane) {
  Box box;
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    box.lower[static_cast<int>(axis)] = node.faces[face_of(axis, false)][lane];
    box.upper[static_cast<int>(axis)] = node.faces[face_of(axis, true)][lane];
  }
  return box;
}

bool is_within(const Box& inner, const Box& outer) {
  for (int k = 0; k < 3; ++k)
    if (inner.lower[k] < outer.lower[k] || inner.upper[k] > outer.upper[k]) return false;
  return true;
}

WideChild child_of(const WideNode& node, std::uint32_t lane) { return WideChild(node.children[lane].load()); }

/// Calls visit(box around the node, node, lane) for each child, those of made nodes below it.
template <class Visit>
void for_each_child(const WideTree& tree, std::uint32_t index, const Box& around, Visit&& visit) {
  const WideNode& node = tree.node(index);
  for (std::uint32_t lane = 0; lane < kBlockLanes; ++lane) {
    const WideChild child = child_of(node, lane);
    const Box box = box_of(node, lane);
    if (child.bits() == 0 && box.lower.x > box.upper.x) continue;
    visit(around, box, child);
    if (!child.is_leaf()) for_each_child(tree, tree.enter(node, lane), box, visit);
  }
}

/// The part of a triangle on one side of a plane (Sutherland & Hodgman 1974).
std::vector<DVec3> cut(const std::vector<DVec3>& polygon, int axis, double plane, bool keep_low) {
  std::vector<DVec3> result;
  const auto depth = [&](const DVec3& p) { return keep_low ? plane - p[axis] : p[axis] - plane; };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const DVec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if (depth(a) >= 0) result.push_back(a);
    if ((depth(a) < 0) != (depth(b) < 0)) result.push_back(a + (b - a) * (depth(a) / (depth(a) - depth(b))));
  }
  return result;
}

std::vector<DVec3> part_within(const Triangle& triangle, const Box& cell) {
  std::vector<DVec3> part;
  for (const Vec3& v : triangle.v) part.push_back(DVec3(v));
  for (int axis = 0; axis < 3; ++axis) {
    part = cut(part, axis, static_cast<double>(cell.lower[axis]), false);
    part = cut(part, axis, static_cast<double>(cell.upper[axis]), true);
  }
  return part;
}

Triangle scaled_to_tree(Triangle triangle, const Tree& tree) {
  for (Vec3& v : triangle.v) v *= std::ldexp(1.0f, tree.scale_exponent);
  return triangle;
}

/// Where the tree has a leaf: its node and cell by its first block.
struct LeafCells {
  std::map<std::uint32_t, std::pair<std::uint32_t, Box>> by_block;

  explicit LeafCells(const Tree& tree) { add(tree, 0, tree.root); }
  void add(const Tree& tree, std::uint32_t at, const Box& cell) {
    const Node& node = tree.nodes[at];
    if (node.is_leaf()) {
      if (node.block_count() > 0) by_block[node.first_block()] = {at, cell};
      return;
    }
    add(tree, node.low_child(), half_cell(cell, node, false));
    add(tree, node.low_child() + 1, half_cell(cell, node, true));
  }
};

std::vector<std::vector<Triangle>> geometries() {
  return {random_soup(1, 0.5f, 71), random_soup(200, 0.02f, 72), random_soup(200, 0.5f, 73),
          random_soup(2000, 0.2f, 74)};
}

TEST(WideTree, HoldsEachLeafOnce) {
  for (const std::vector<Triangle>& triangles : geometries()) {
    const SmallScene scene(triangles);
    const WideTree wide(scene.tree, scene.triangles.data());
    const LeafCells leaves(scene.tree);
    std::map<std::uint32_t, int> seen;
    for_each_child(wide, 0, scene.tree.root, [&](const Box&, const Box&, WideChild child) {
      if (!child.is_leaf()) return;
      const auto leaf = leaves.by_block.find(child.run().first);
      ASSERT_NE(leaf, leaves.by_block.end());
      ASSERT_EQ(child.run().count, scene.tree.nodes[leaf->second.first].block_count());
      ASSERT_EQ(++seen[child.run().first], 1);
    });
    EXPECT_EQ(seen.size(), leaves.by_block.size());
  }
}

TEST(WideTree, BoxesHoldWhatIsInThem) {
  for (const std::vector<Triangle>& triangles : geometries()) {
    const SmallScene scene(triangles);
    const WideTree wide(scene.tree, scene.triangles.data());
    const LeafCells leaves(scene.tree);
    // What a leaf holds may reach beyond its cell by eps, its box by eps again, and some units in the last place.
    const Vec3 most(2 * scene.tree.eps + 0x1p-22f);
    for_each_child(wide, 0, scene.tree.root, [&](const Box& around, const Box& box, WideChild child) {
      ASSERT_TRUE(is_within(box, {around.lower - most, around.upper + most}));
      if (!child.is_leaf()) {
        ASSERT_TRUE(is_within(box, around)) << "cells lie within cells";
        return;
      }
      const Box& cell = leaves.by_block.at(child.run().first).second;
      ASSERT_TRUE(is_within(box, {cell.lower - most, cell.upper + most}));
      for (std::uint32_t b = 0; b < child.run().count; ++b) {
        const Block& block = scene.tree.blocks[child.run().first + b];
        for (std::uint32_t lane = 0; lane < block.count; ++lane) {
          const Triangle triangle = scaled_to_tree(scene.triangles[block.id[lane]], scene.tree);
          for (const DVec3& point : part_within(triangle, cell)) {
            for (int k = 0; k < 3; ++k) {
              ASSERT_GE(point[k], static_cast<double>(box.lower[k]));
              ASSERT_LE(point[k], static_cast<double>(box.upper[k]));
            }
          }
        }
      }
    });
  }
}

/// Each child's box and run, in an order that does not depend on who made which node.
std::vector<std::vector<float>> contents(const WideTree& tree, const Box& root) {
  std::vector<std::vector<float>> result;
  for_each_child(tree, 0, root, [&](const Box&, const Box& box, WideChild child) {
    std::vector<float> row{box.lower.x, box.lower.y, box.lower.z, box.upper.x, box.upper.y, box.upper.z};
    if (child.is_leaf()) row.push_back(static_cast<float>(child.run().first));
    result.push_back(row);
  });
  return result;
}

TEST(WideTree, SeveralThreadsMakeTheSame) {
  const SmallScene scene(random_soup(3000, 0.1f, 75));
  const WideTree alone(scene.tree, scene.triangles.data());
  const std::vector<std::vector<float>> expected = contents(alone, scene.tree.root);
  const WideTree shared(scene.tree, scene.triangles.data());
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&] { EXPECT_EQ(contents(shared, scene.tree.root), expected); });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(shared.bytes(), alone.bytes()) << "each node is made once";
}

}  // namespace
}  // namespace umbrix::detail
