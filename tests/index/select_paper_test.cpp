// SPDX-License-Identifier: Apache-2.0
#include "index/select_paper.h"

#include <gtest/gtest.h>

#include <cmath>

#include "index/subtree_costs.h"
#include "small_scene.h"

namespace umbrix::detail {
namespace {

/// The unit cube split at x = 1/2 and its low half at y = 1/2: three leaves of forty triangles each. Triangle 0 spans
/// the cube at z = 1/2, the others are specks.
struct HandMade {
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> kept;
  Tree tree;

  HandMade() : triangles(120, {{Vec3(0.1f), Vec3(0.11f, 0.1f, 0.1f), Vec3(0.1f, 0.11f, 0.1f)}}), kept(120) {
    triangles[0] = {{Vec3(0, 0, 0.5f), Vec3(1, 0, 0.5f), Vec3(0, 1, 0.5f)}};
    std::iota(kept.begin(), kept.end(), 0u);
    tree.root.lower = Vec3(0);
    tree.root.upper = Vec3(1);
    tree.blocks.resize(15);
    for (Block& block : tree.blocks) block.count = 8;
    tree.nodes = {Node::inner(0, 0.5f, 2), Node::leaf(0, 0), Node::inner(1, 0.5f, 4),
                  Node::leaf(0, 5),        Node::leaf(5, 5), Node::leaf(10, 5)};
  }

  std::vector<Placement> select(const PaperOptions& options) const {
    return select_paper(tree, triangles.data(), kept.data(), kept.size(), options);
  }
};

// Five blocks of eight; half the cube's and the quarter's surface by what they are cut from.
constexpr double kLeaf = 5 * 1.5 + 40 * 0.2, kTest = 1.5 + 0.2;
constexpr double kHalfCost = 1 + 2 * (1.25 / 2.0) * kLeaf;
constexpr double kRootCost = 1 + (2.0 / 3) * kHalfCost + (2.0 / 3) * kLeaf;

PaperOptions anywhere() {
  PaperOptions options;
  options.most_share = 1;
  options.band_low = 0;
  options.band_high = 1;
  options.least_inner_nodes = 1;
  return options;
}

TEST(SubtreeCosts, AreThoseOfTheSurfaceAreaHeuristic) {
  const SubtreeCosts costs = subtree_costs(HandMade().tree);
  EXPECT_FLOAT_EQ(costs.expected[4], static_cast<float>(kLeaf));
  EXPECT_FLOAT_EQ(costs.expected[2], static_cast<float>(kHalfCost));
  EXPECT_FLOAT_EQ(costs.expected[0], static_cast<float>(kRootCost));
  EXPECT_FLOAT_EQ(costs.local[0], static_cast<float>(1 + (2.0 / 3) * (15 + 16) + (2.0 / 3) * kLeaf));
  EXPECT_EQ(costs.inner_nodes[0], 2u);
  EXPECT_EQ(costs.depth, 2u);
}

/// Expects the triangle at `node`, for a threshold just below its score and no other.
void expect_score(PaperOptions options, double score, std::uint32_t node) {
  const HandMade scene;
  options.threshold = score * 0.9999;
  const std::vector<Placement> placements = scene.select(options);
  ASSERT_EQ(placements.size(), 1u);
  EXPECT_EQ(placements[0].node, node);
  EXPECT_EQ(placements[0].triangle, 0u);
  options.threshold = score * 1.0001;
  EXPECT_TRUE(scene.select(options).empty());
}

TEST(SelectPaper, ScoresByTheClosedForm) {
  // At the root the box is a third of the surface; in the low half 1/2 of 2, a step deeper.
  const double root = 1.0 / 3 - kTest / kRootCost, half = 0.6 * (0.5 / 2 - kTest / kHalfCost);
  ASSERT_GT(root, half);
  expect_score(anywhere(), root, 0);
  PaperOptions below_root = anywhere();
  below_root.band_low = 0.5;
  expect_score(below_root, half, 2);
}

TEST(SelectPaper, ScoresByAreaAndShareOfLines) {
  PaperOptions options = anywhere();
  options.reading = PaperReading::area;
  expect_score(options, 0.5 / 3 * kRootCost - kTest, 0);
  options.band_low = 0.5;
  expect_score(options, (2.0 / 3) * (0.375 / 2 * kHalfCost - kTest), 2);
}

TEST(SelectPaper, CountsWhatStandsThereAlready) {
  HandMade scene;
  scene.triangles[7] = scene.triangles[0];
  PaperOptions options = anywhere();
  options.reading = PaperReading::area;
  options.band_high = 0;
  // The second meets the lines that the first lets through, and its test is another lane of the same block.
  const double p = 0.5 / 3, first = p * kRootCost - kTest, second = (1 - p) * p * kRootCost - 0.2;
  options.least_gain = (first + second) / kRootCost * 0.9999;
  EXPECT_EQ(scene.select(options).size(), 2u);
  options.least_gain = (first + second) / kRootCost * 1.0001;
  EXPECT_TRUE(scene.select(options).empty());
  options.least_gain = 0;
  options.per_node = 1;
  EXPECT_EQ(scene.select(options).size(), 1u);
}

TEST(SelectPaper, PlacesNothingThatDoesNotPay) {
  PaperOptions options = anywhere();
  const double gain = kRootCost / 3 - kTest;
  options.least_gain = gain / kRootCost * 0.9999;
  EXPECT_EQ(HandMade().select(options).size(), 1u);
  options.least_gain = gain / kRootCost * 1.0001;
  EXPECT_TRUE(HandMade().select(options).empty());
  EXPECT_TRUE(select_paper(HandMade().tree, nullptr, nullptr, 0).empty());
}

TEST(SelectPaper, KeepsItsLimits) {
  std::vector<Triangle> triangles = random_soup(2000, 0.03f, 1);
  for (Triangle& t : random_soup(40, 1, 2)) triangles.push_back(t);
  const SmallScene scene(std::move(triangles));
  for (const PaperReading reading : {PaperReading::expected, PaperReading::area, PaperReading::literal}) {
    PaperOptions options;
    options.reading = reading;
    options.nodes_per_triangle = 8;
    options.least_gain = -1e9;
    const std::vector<Placement> placements =
        select_paper(scene.tree, scene.triangles.data(), scene.kept.data(), scene.kept.size(), options);
    ASSERT_FALSE(placements.empty());
    std::vector<std::uint32_t> at_node(scene.tree.nodes.size()), of_triangle(scene.triangles.size());
    for (const Placement& p : placements) {
      EXPECT_LE(++at_node[p.node], options.per_node);
      EXPECT_LE(++of_triangle[p.triangle], options.nodes_per_triangle);
      EXPECT_GE(p.triangle, 2000u) << "only the large";
    }
  }
}

}  // namespace
}  // namespace umbrix::detail
