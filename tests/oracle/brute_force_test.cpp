// SPDX-License-Identifier: Apache-2.0
//
// The fast judge against the slow one: its rejections must never lose a hit.
#include "oracle/brute_force.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "case_parameters.h"
#include "cases/cases.h"
#include "test_rays.h"

namespace umbrix::oracle {
namespace {

class BruteForceCase : public testing::TestWithParam<const char*> {};

TEST_P(BruteForceCase, AgreesWithExactTestsOfEveryTriangle) {
  const cases::Case& c = *cases::find_case(GetParam());
  std::size_t occluded = 0;
  for (std::uint64_t seed = 7; seed < 11; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const cases::CaseData data = c.make(seed, std::min<std::size_t>(test_rays(30), 30));
    const BruteForce brute(data.triangles);
    for (const Ray& ray : data.rays) {
      std::optional<ExactHit> best;
      std::uint32_t nearest = 0;
      for (std::uint32_t i = 0; i < data.triangles.size(); ++i) {
        const auto hit = exact_intersection(ray, data.triangles[i].v);
        if (hit && (!best || compare_t(*hit, *best) < 0)) {
          best = hit;
          nearest = i;
        }
      }
      ASSERT_EQ(brute.occluded(ray), best.has_value());
      const auto closest = brute.closest(ray);
      ASSERT_EQ(closest.has_value(), best.has_value());
      if (!best) continue;
      ++occluded;
      EXPECT_EQ(closest->triangle, nearest);
      EXPECT_EQ(closest->t, best->t());
    }
  }
  EXPECT_GT(occluded, 0u) << "a case whose rays hit nothing tests nothing";
}

INSTANTIATE_TEST_SUITE_P(AllCases, BruteForceCase, testing::ValuesIn(case_names()), case_test_name);

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
  for (const cases::Case& c : cases::all_cases()) {
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
