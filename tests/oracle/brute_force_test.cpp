// SPDX-License-Identifier: Apache-2.0
//
// The fast judges against the slow one: their rejections must never lose a hit.
#include "oracle/brute_force.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "case_parameters.h"
#include "cases/cases.h"
#include "oracle/box_tree.h"
#include "test_rays.h"

namespace umbrix::oracle {
namespace {

// The nearest hit by exact tests of every triangle.
std::optional<Closest> slow_closest(const std::vector<Triangle>& triangles, const Ray& ray) {
  std::optional<ExactHit> best;
  std::uint32_t nearest = 0;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const auto hit = exact_intersection(ray, triangles[i].v);
    if (hit && (!best || compare_t(*hit, *best) < 0)) {
      best = hit;
      nearest = i;
    }
  }
  if (!best) return std::nullopt;
  return Closest{nearest, best->t(), best->u(), best->v()};
}

template <typename Judge>
void expect_same(const Judge& judge, const Ray& ray, const std::optional<Closest>& truth) {
  EXPECT_EQ(judge.occluded(ray), truth.has_value());
  const auto closest = judge.closest(ray);
  ASSERT_EQ(closest.has_value(), truth.has_value());
  if (!truth) return;
  EXPECT_EQ(closest->triangle, truth->triangle);
  EXPECT_EQ(closest->t, truth->t);
}

class FastJudge : public testing::TestWithParam<const char*> {};

TEST_P(FastJudge, AgreesWithExactTestsOfEveryTriangle) {
  const cases::Case& c = *cases::find_case(GetParam());
  std::size_t occluded = 0;
  for (std::uint64_t seed = 7; seed < 11; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const cases::CaseData data = c.make(seed, std::min<std::size_t>(test_rays(20), 20));
    const BruteForce brute(data.triangles);
    const BoxTree tree(data.triangles);
    // Exact tests of large scenes take long; a few rays there will do.
    const std::size_t rays = std::min(data.rays.size(), 1 + 6000 / std::max<std::size_t>(1, data.triangles.size()));
    for (std::size_t i = 0; i < rays; ++i) {
      SCOPED_TRACE(testing::Message() << "ray " << i);
      const std::optional<Closest> truth = slow_closest(data.triangles, data.rays[i]);
      expect_same(brute, data.rays[i], truth);
      expect_same(tree, data.rays[i], truth);
      occluded += truth.has_value() ? 1 : 0;
    }
  }
  if (c.claim != cases::Claim::none_occluded && c.row != 20) {
    EXPECT_GT(occluded, 0u) << "a case whose rays hit nothing tests nothing";
  }
}

INSTANTIATE_TEST_SUITE_P(AllCases, FastJudge, testing::ValuesIn(case_names()), case_test_name);

TEST(BoxTree, AgreesWithBruteForceInLargerScenes) {
  for (const cases::Case& c : cases::all_cases(0.005)) {
    if (c.row != 10 && c.row != 17 && c.row != 21 && c.row != 28) continue;
    SCOPED_TRACE(c.name);
    const cases::CaseData data = c.make(1, test_rays(150));
    const BruteForce brute(data.triangles);
    const BoxTree tree(data.triangles);
    for (std::size_t i = 0; i < data.rays.size(); ++i) {
      ASSERT_EQ(tree.occluded(data.rays[i]), brute.occluded(data.rays[i])) << "ray " << i;
    }
  }
}

TEST(BruteForce, SeesOnlyVisibleTriangles) {
  const Triangle low = {{{-1, -1, 1}, {2, -1, 1}, {-1, 2, 1}}}, high = {{{-1, -1, 2}, {2, -1, 2}, {-1, 2, 2}}};
  const BruteForce brute({low, high, high});
  const Ray ray = {{0, 0, 0}, 0, {0, 0, 1}, 10};
  EXPECT_EQ(brute.closest(ray)->triangle, 0u);
  EXPECT_EQ(brute.closest(ray, [](std::uint32_t i) { return i != 0; })->triangle, 1u) << "of equals the lowest";
  EXPECT_FALSE(brute.occluded(ray, [](std::uint32_t) { return false; }));
  EXPECT_TRUE(brute.occluded(ray, [](std::uint32_t i) { return i == 2; }));
}

TEST(BruteForce, MakesTheSameDataFromTheSameSeed) {
  for (const cases::Case& c : cases::small_cases()) {
    SCOPED_TRACE(c.name);
    const cases::CaseData a = c.make(3, 50), b = c.make(3, 50);
    ASSERT_EQ(a.triangles.size(), b.triangles.size());
    ASSERT_EQ(a.rays.size(), 50u);
    // An empty vector's data may be null, which memcmp must not see.
    if (!a.triangles.empty()) {
      EXPECT_EQ(std::memcmp(a.triangles.data(), b.triangles.data(), a.triangles.size() * sizeof(Triangle)), 0);
    }
    EXPECT_EQ(std::memcmp(a.rays.data(), b.rays.data(), a.rays.size() * sizeof(Ray)), 0);
  }
}

}  // namespace
}  // namespace umbrix::oracle
