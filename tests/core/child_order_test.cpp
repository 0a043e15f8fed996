// SPDX-License-Identifier: Apache-2.0
// Orders of children on a tree made by hand, where the right one can be seen.

#include <gtest/gtest.h>

#include <cmath>

#include "index/parents.h"
#include "index/rtsah_order.h"
#include "index/sato_order.h"
#include "index/srdh_order.h"
#include "index/subtree_measures.h"
#include "tree/block.h"

namespace umbrix::detail {
namespace {

/// The unit cube, split at x = 1/4 (node 0) and its high side at y = 1/2 (node 3). Node 2 (low x) holds triangle 0,
/// which covers its cell's middle; node 4 (high x, low y) holds five small triangles; node 5 holds nothing.
class HandMadeTree : public testing::Test {
 protected:
  HandMadeTree() {
    tree_.root = {Vec3(0), Vec3(1)};
    tree_.eps = 0x1p-20f;
    triangles_.push_back({{Vec3(0.125f, 0, 0), Vec3(0.125f, 1, 0), Vec3(0.125f, 0, 1)}});
    for (int i = 0; i < 5; ++i) {
      const Vec3 o(0.5f, 0.125f, 0.125f * static_cast<float>(i + 1));
      triangles_.push_back({{o, o + Vec3(0.125f, 0, 0), o + Vec3(0, 0.125f, 0)}});
    }
    tree_.nodes = {Node::inner(0, 0.25f, 2), Node::leaf(0, 0), Node::leaf(0, 1),
                   Node::inner(1, 0.5f, 4),  Node::leaf(1, 1), Node::leaf(0, 0)};
    tree_.blocks.resize(2);
    pack();
  }

  void pack() {
    const std::uint32_t ids[] = {0, 1, 2, 3, 4, 5};
    pack_block(
        ids, 1, [&](std::uint32_t id) -> const Triangle& { return triangles_[id]; }, 2, tree_.blocks[0]);
    pack_block(
        ids + 1, 5, [&](std::uint32_t id) -> const Triangle& { return triangles_[id]; }, 2, tree_.blocks[1]);
  }

  bool root_is_high_first(SatoMeasure measure) const {
    const auto order = make_sato_order(tree_, measure, nullptr);
    EXPECT_FALSE(order->is_high_first(3)) << "an empty child is never first";
    return order->is_high_first(0);
  }

  /// A ray in +x through both sides of the root.
  static TrainingRay along_x(std::uint32_t first_blocker, std::uint32_t blocker_count) {
    return {{-1, 0.25f, 0.25f}, {1, 0x1p64f, 0x1p64f}, 1, 2, first_blocker, blocker_count};
  }

  std::vector<Triangle> triangles_;
  Tree tree_;
};

TEST_F(HandMadeTree, IsMeasured) {
  const std::vector<double> cells = cell_areas(tree_);
  EXPECT_DOUBLE_EQ(cells[0], 3);
  EXPECT_DOUBLE_EQ(cells[2], 1.5);
  EXPECT_DOUBLE_EQ(cells[3], 2.5);
  const std::vector<double> areas = triangle_areas(tree_, nullptr);
  EXPECT_DOUBLE_EQ(areas[2], 0.5);
  EXPECT_DOUBLE_EQ(areas[3], 5 * 0.125 * 0.125 / 2);
  EXPECT_DOUBLE_EQ(areas[0], areas[2] + areas[3]);
  const std::vector<double> boxes = tight_box_areas(tree_, nullptr);
  EXPECT_DOUBLE_EQ(boxes[2], 1);
  EXPECT_DOUBLE_EQ(boxes[3], 0.125 * 0.125 + 2 * 0.125 * 0.5);
  EXPECT_DOUBLE_EQ(boxes[5], 0);
  const std::vector<double> visibilities = leaf_visibilities(tree_, nullptr);
  EXPECT_DOUBLE_EQ(visibilities[2], 1 - 0.5 / 1.5);
  EXPECT_DOUBLE_EQ(visibilities[5], 1);
}

TEST_F(HandMadeTree, CountsATriangleInSeveralLeavesOnce) {
  const std::uint32_t ids[] = {0, 1};
  pack_block(
      ids, 2, [&](std::uint32_t id) -> const Triangle& { return triangles_[id]; }, 2, tree_.blocks[0]);
  tree_.nodes[5] = Node::leaf(2, 1);
  tree_.blocks.push_back(tree_.blocks[0]);
  const std::vector<double> counts = triangle_counts(tree_);
  EXPECT_EQ(counts[2], 2);
  EXPECT_EQ(counts[4], 5);
  EXPECT_EQ(counts[5], 2);
  EXPECT_EQ(counts[3], 6);
  EXPECT_EQ(counts[0], 6);
}

TEST_F(HandMadeTree, SatoTakesTheLargerChildFirst) {
  EXPECT_FALSE(root_is_high_first(SatoMeasure::tight_box));
  EXPECT_FALSE(root_is_high_first(SatoMeasure::triangle_area));
  EXPECT_TRUE(root_is_high_first(SatoMeasure::triangle_count));
  EXPECT_TRUE(root_is_high_first(SatoMeasure::cell));
}

TEST_F(HandMadeTree, RtsahTakesTheChildFirstThatStopsMoreForLess) {
  EXPECT_FALSE(make_rtsah_order(tree_, nullptr)->is_high_first(0));
  // The same numbers of triangles, but now the five stop nearly everything and the one nearly nothing.
  triangles_[0] = {{Vec3(0.125f, 0, 0), Vec3(0.125f, 0.0625f, 0), Vec3(0.125f, 0, 0.0625f)}};
  for (std::size_t i = 1; i < triangles_.size(); ++i)
    triangles_[i] = {{Vec3(0.25f, 0.25f, 0), Vec3(1, 0.25f, 0), Vec3(0.25f, 0.25f, 1)}};
  pack();
  EXPECT_TRUE(make_rtsah_order(tree_, nullptr)->is_high_first(0));
}

TEST_F(HandMadeTree, SrdhTakesTheChildFirstThatHoldsTheBlockers) {
  TrainingRays training;
  training.blockers = {0, 1};
  training.rays = {along_x(0, 1)};
  EXPECT_FALSE(make_srdh_order(tree_, training, nullptr)->is_high_first(0));
  training.rays = {along_x(1, 1)};
  EXPECT_TRUE(make_srdh_order(tree_, training, nullptr)->is_high_first(0));
  training.rays = {along_x(0, 2)};
  EXPECT_FALSE(make_srdh_order(tree_, training, nullptr)->is_high_first(0)) << "in both: the one with fewer triangles";
  training.rays = {along_x(0, 1), along_x(1, 1)};
  EXPECT_FALSE(make_srdh_order(tree_, training, nullptr)->is_high_first(0)) << "five triangles against one";
  training.rays.insert(training.rays.end(), 5, along_x(1, 1));
  EXPECT_TRUE(make_srdh_order(tree_, training, nullptr)->is_high_first(0)) << "but six rays against one";
}

TEST_F(HandMadeTree, ParentsKnowTheirCells) {
  const Parents parents(tree_);
  EXPECT_EQ(parents.of(2).node, 0u);
  EXPECT_EQ(parents.of(5).node, 3u);
  for (std::uint32_t face = 0; face < kFaces; ++face) EXPECT_TRUE(std::isinf(parents.of(3).faces[face]));
  EXPECT_EQ(parents.of(4).faces[face_of(0, false)], 0.25f);
  EXPECT_TRUE(std::isinf(parents.of(4).faces[face_of(0, true)]));
  EXPECT_TRUE(std::isinf(parents.of(4).faces[face_of(1, true)]));
}

}  // namespace
}  // namespace umbrix::detail
