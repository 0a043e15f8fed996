// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numeric>
#include <random>
#include <thread>

#include "core/exact_test.h"
#include "tree/builder.h"
#include "tree/check.h"

namespace umbrix::detail {
namespace {

struct Soup {
  std::string name;
  std::vector<Triangle> triangles;
};

Vec3 random_point(std::mt19937& random) {
  std::uniform_real_distribution<float> u(-1, 1);
  return {u(random), u(random), u(random)};
}

std::vector<Triangle> random_soup(std::size_t count, float size, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<Triangle> result(count);
  for (Triangle& t : result) {
    const Vec3 center = random_point(random);
    for (Vec3& v : t.v) v = center + size * random_point(random);
  }
  return result;
}

/// Walls, floors and steps: triangles that lie in the planes the heuristic wants to split at.
std::vector<Triangle> blocks_on_a_grid(int side) {
  std::vector<Triangle> result;
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y) {
      const Vec3 o(x, y, (x * 7 + y * 3) % 5);
      const Vec3 a = o + Vec3(1, 0, 0), b = o + Vec3(0, 1, 0), c = o + Vec3(1, 1, 0), d = o + Vec3(0, 0, 1);
      result.insert(result.end(), {{{o, a, c}}, {{o, c, b}}, {{o, a, d}}, {{o, b, d}}});
    }
  return result;
}

std::vector<Triangle> moved(std::vector<Triangle> triangles, float scale, const Vec3& offset) {
  for (Triangle& t : triangles)
    for (Vec3& v : t.v) v = v * scale + offset;
  return triangles;
}

std::vector<Soup> soups() {
  std::vector<Triangle> coincident(2000, Triangle{{Vec3(0, 0, 0), Vec3(1, 0, 0.5f), Vec3(0, 1, 0.25f)}});
  std::vector<Triangle> shrinking;
  for (int k = 0; k < 60; ++k)
    shrinking.push_back(
        {{Vec3(0), Vec3(std::ldexp(1.0f, -k), 0, 0), Vec3(0, std::ldexp(1.0f, -k), std::ldexp(1.0f, -k))}});
  std::vector<Triangle> flat = random_soup(500, 0.1f, 3);
  for (Triangle& t : flat)
    for (Vec3& v : t.v) v.y = 0.25f;
  return {{"one", random_soup(1, 1, 1)},
          {"small", random_soup(3000, 0.05f, 2)},
          {"large", random_soup(600, 1, 4)},
          {"grid", blocks_on_a_grid(24)},
          {"far_away", moved(random_soup(2000, 0.1f, 5), 1, Vec3(1e4f, -2e4f, 3e4f))},
          {"tiny", moved(random_soup(500, 0.1f, 6), 0x1p-120f, Vec3(0))},
          {"huge", moved(random_soup(500, 0.1f, 7), 0x1p+120f, Vec3(0))},
          {"coincident", coincident},
          {"shrinking", shrinking},
          {"flat", flat}};
}

std::vector<std::uint32_t> solid(const std::vector<Triangle>& triangles) {
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
    if (!is_degenerate(triangles[i])) kept.push_back(i);
  return kept;
}

class TreeTest : public testing::TestWithParam<BuildQuality> {};

TEST_P(TreeTest, HoldsEveryTriangleWhereverARayMayMeetIt) {
  for (const Soup& soup : soups()) {
    SCOPED_TRACE(soup.name);
    BuildStats stats;
    const std::vector<std::uint32_t> kept = solid(soup.triangles);
    const Tree tree = build_tree(soup.triangles, kept, GetParam(), nullptr, stats);
    EXPECT_EQ(check_tree(tree, soup.triangles, kept), "");
    EXPECT_LE(stats.references, 4 * kept.size() + 1'000'000);
    EXPECT_GE(stats.references, kept.size());
    EXPECT_EQ(stats.nodes, 2 * stats.leaves - 1);
  }
}

TEST_P(TreeTest, IsTheSameForAnyNumberOfThreads) {
  // An executor that runs one or three calls at once; oneTBB is a third schedule.
  const auto threaded = [](void* context, std::size_t count, void (*body)(void*, std::size_t), void* data) {
    const std::size_t threads = *static_cast<std::size_t*>(context);
    std::vector<std::thread> pool;
    for (std::size_t t = 0; t < threads; ++t)
      pool.emplace_back([=] {
        for (std::size_t i = t; i < count; i += threads) body(data, i);
      });
    for (std::thread& t : pool) t.join();
  };
  const std::vector<Triangle> triangles = random_soup(30000, 0.02f, 8);
  const std::vector<std::uint32_t> kept = solid(triangles);
  BuildStats stats;
  const Tree reference = build_tree(triangles, kept, GetParam(), nullptr, stats);
  for (std::size_t threads : {std::size_t{1}, std::size_t{3}}) {
    const Executor executor{threaded, &threads};
    BuildStats other;
    const Tree tree = build_tree(triangles, kept, GetParam(), &executor, other);
    ASSERT_EQ(tree.nodes.size(), reference.nodes.size());
    EXPECT_EQ(std::memcmp(tree.nodes.data(), reference.nodes.data(), tree.nodes.size() * sizeof(Node)), 0);
    ASSERT_EQ(tree.blocks.size(), reference.blocks.size());
    for (std::size_t i = 0; i < tree.blocks.size(); ++i)
      ASSERT_TRUE(std::equal(tree.blocks[i].id, tree.blocks[i].id + kBlockLanes, reference.blocks[i].id));
  }
}

std::string name_of(const testing::TestParamInfo<BuildQuality>& param) {
  return param.param == BuildQuality::high ? "high" : "fast";
}

INSTANTIATE_TEST_SUITE_P(Qualities, TreeTest, testing::Values(BuildQuality::high, BuildQuality::fast), name_of);

TEST(TreeCheck, FindsFaults) {
  const std::vector<Triangle> triangles = random_soup(400, 0.1f, 9);
  const std::vector<std::uint32_t> kept = solid(triangles);
  BuildStats stats;
  const Tree good = build_tree(triangles, kept, BuildQuality::high, nullptr, stats);
  ASSERT_EQ(check_tree(good, triangles, kept), "");

  Tree moved_plane = good;
  moved_plane.nodes[0] = Node::inner(static_cast<int>(good.nodes[0].axis_bits()), 5.0f, good.nodes[0].low_child());
  EXPECT_NE(check_tree(moved_plane, triangles, kept), "");

  Tree lost_triangle = good;
  for (Block& block : lost_triangle.blocks)
    if (block.count > 1) {
      --block.count;
      for (std::uint32_t lane = block.count; lane < kBlockLanes; ++lane) {
        block.id[lane] = block.id[0];
        for (int k = 0; k < 3; ++k) {
          block.v0[k][lane] = block.v0[k][0];
          block.e1[k][lane] = block.e1[k][0];
          block.e2[k][lane] = block.e2[k][0];
        }
      }
      break;
    }
  EXPECT_NE(check_tree(lost_triangle, triangles, kept), "");

  Tree short_bound = good;
  short_bound.blocks[0].edge_bound *= 0.5f;
  EXPECT_NE(check_tree(short_bound, triangles, kept), "");
}

}  // namespace
}  // namespace umbrix::detail
