// SPDX-License-Identifier: Apache-2.0
//
// The judge itself: hand-made answers, and a second formulation in rationals.
#include "oracle/exact_hit.h"

#include <gtest/gtest.h>

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>
#include <optional>

#include "cases/cases.h"
#include "cases/random.h"
#include "test_rays.h"

namespace umbrix::oracle {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kDenormal = std::numeric_limits<float>::denorm_min();

// In the plane z = 1, with the right angle at (0, 0, 1).
constexpr Triangle kCorner = {{{0, 0, 1}, {4, 0, 1}, {0, 4, 1}}};

Ray upwards(float x, float y, float tmin = 0, float tmax = kInfinity) { return {{x, y, 0}, tmin, {0, 0, 1}, tmax}; }

bool hit(const Ray& ray, const Triangle& triangle = kCorner) { return exact_hit(ray, triangle.v); }

TEST(ExactHit, TriangleIsClosed) {
  EXPECT_TRUE(hit(upwards(1, 1)));
  EXPECT_TRUE(hit(upwards(0, 0))) << "vertex";
  EXPECT_TRUE(hit(upwards(4, 0))) << "vertex";
  EXPECT_TRUE(hit(upwards(2, 0))) << "edge";
  EXPECT_TRUE(hit(upwards(2, 2))) << "longest edge";
  EXPECT_FALSE(hit(upwards(2, std::nextafter(2.0f, 3.0f))));
  EXPECT_FALSE(hit(upwards(-kDenormal, 1))) << "outside by the smallest float";
  EXPECT_TRUE(hit(upwards(kDenormal, 1)));
}

TEST(ExactHit, BothSidesOfATriangleAreHit) {
  const Triangle turned = {{{0, 0, 1}, {0, 4, 1}, {4, 0, 1}}};
  EXPECT_TRUE(hit(upwards(1, 1), turned));
  EXPECT_TRUE(hit({{1, 1, 2}, 0, {0, 0, -1}, 2}));
}

TEST(ExactHit, IntervalIsOpen) {
  EXPECT_FALSE(hit(upwards(1, 1, 0, 1)));
  EXPECT_TRUE(hit(upwards(1, 1, 0, std::nextafter(1.0f, 2.0f))));
  EXPECT_FALSE(hit(upwards(1, 1, 1, 2)));
  EXPECT_TRUE(hit(upwards(1, 1, std::nextafter(1.0f, 0.0f), 2)));
  EXPECT_TRUE(hit(upwards(1, 1, -kInfinity, kInfinity)));
  EXPECT_FALSE(hit({{1, 1, 2}, 0, {0, 0, 1}, kInfinity})) << "behind";
  EXPECT_TRUE(hit({{1, 1, 2}, -kInfinity, {0, 0, 1}, 0})) << "negative t";
  EXPECT_FALSE(hit({{1, 1, 1}, 0, {0, 0, 1}, 1})) << "origin on the triangle";
}

TEST(ExactHit, RayInThePlaneMisses) {
  EXPECT_FALSE(hit({{-1, 1, 1}, 0, {1, 0, 0}, kInfinity}));
  EXPECT_FALSE(hit({{1, 1, 1}, -1, {1, 1, 0}, 1}));
  EXPECT_TRUE(hit({{-1, 1, 1}, 0, {1, 0, kDenormal}, kInfinity}) || !hit({{-1, 1, 1}, 0, {1, 0, kDenormal}, 1}));
}

TEST(ExactHit, TriangleWithoutAreaIsNeverHit) {
  EXPECT_FALSE(hit(upwards(1, 1), {{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}}));
  EXPECT_FALSE(hit(upwards(1, 1), {{{0, 0, 1}, {1, 1, 1}, {3, 3, 1}}}));
  EXPECT_TRUE(hit(upwards(1, 1), {{{0, 0, 1}, {2, 2, 1}, {3, std::nextafter(3.0f, 4.0f), 1}}})) << "but a needle is";
}

TEST(ExactHit, WhatIsNotFiniteIsNeverHit) {
  for (const float bad : {kNaN, kInfinity, -kInfinity}) {
    SCOPED_TRACE(bad);
    EXPECT_FALSE(hit(upwards(1, 1), {{{0, 0, 1}, {4, bad, 1}, {0, 4, 1}}}));
    EXPECT_FALSE(hit({{bad, 1, 0}, 0, {0, 0, 1}, 2}));
    EXPECT_FALSE(hit({{1, 1, 0}, 0, {0, bad, 1}, 2}));
  }
  EXPECT_FALSE(hit(upwards(1, 1, kNaN, 2)));
  EXPECT_FALSE(hit(upwards(1, 1, 0, kNaN)));
  EXPECT_FALSE(hit(upwards(1, 1, 2, 0)));
  EXPECT_FALSE(hit(upwards(1, 1, kInfinity, kInfinity)));
  EXPECT_FALSE(hit({{1, 1, 0}, 0, {0, -0.0f, 0}, 2}));
}

TEST(ExactHit, EveryMagnitudeCounts) {
  const float least = kDenormal, most = std::numeric_limits<float>::max();
  EXPECT_TRUE(hit({{0, 0, 0}, 0, {0, 0, least}, kInfinity}, {{{0, 0, least}, {least, 0, least}, {0, least, least}}}));
  EXPECT_TRUE(
      hit({{0, 0, -most}, 0, {0, 0, most}, kInfinity}, {{{-most, -most, most}, {most, 0, most}, {0, most, most}}}));
  EXPECT_FALSE(hit({{0, 0, -most}, 0, {0, 0, most}, 2}, {{{-most, -most, most}, {most, 0, most}, {0, most, most}}}))
      << "t is 2 exactly";
}

TEST(ExactHit, GivesTheParametersOfTheHit) {
  const auto result = exact_intersection({{1, 2, 0}, 0, {0, 0, 4}, 1}, kCorner.v);
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(result->t(), 0.25);
  EXPECT_EQ(result->u(), 0.25);
  EXPECT_EQ(result->v(), 0.5);
}

TEST(ExactHit, ComparesTExactly) {
  const Ray ray = {{1, 1, 0}, 0, {0, 0, 3}, kInfinity};
  const float above = std::nextafter(1.0f, 2.0f);
  const Triangle farther = {{{0, 0, above}, {4, 0, above}, {0, 4, above}}};
  const auto near_hit = exact_intersection(ray, kCorner.v);
  const auto far_hit = exact_intersection(ray, farther.v);
  ASSERT_TRUE(near_hit && far_hit);
  EXPECT_LT(compare_t(*near_hit, *far_hit), 0);
  EXPECT_GT(compare_t(*far_hit, *near_hit), 0);
  EXPECT_EQ(compare_t(*near_hit, *near_hit), 0);
}

using Rational = boost::multiprecision::cpp_rational;
using Rational3 = std::array<Rational, 3>;

// Solves origin + t d = v0 + u e1 + v e2 by Gaussian elimination; nothing if the system is singular.
std::optional<Rational3> solve(const Ray& ray, const Triangle& triangle) {
  std::array<std::array<Rational, 4>, 3> m;
  for (std::size_t k = 0; k < 3; ++k) {
    const Rational v0(triangle.v[0][k]);
    m[k] = {-Rational(ray.direction[k]), Rational(triangle.v[1][k]) - v0, Rational(triangle.v[2][k]) - v0,
            Rational(ray.origin[k]) - v0};
  }
  for (std::size_t column = 0; column < 3; ++column) {
    std::size_t pivot = column;
    while (pivot < 3 && m[pivot][column] == 0) ++pivot;
    if (pivot == 3) return std::nullopt;
    std::swap(m[pivot], m[column]);
    for (std::size_t row = 0; row < 3; ++row) {
      if (row == column) continue;
      const Rational factor = m[row][column] / m[column][column];
      for (std::size_t k = column; k < 4; ++k) m[row][k] -= factor * m[column][k];
    }
  }
  return Rational3{m[0][3] / m[0][0], m[1][3] / m[1][1], m[2][3] / m[2][2]};
}

bool hit_by_elimination(const Ray& ray, const Triangle& triangle) {
  for (const auto& corner : triangle.v) {
    for (const float x : corner) {
      if (!std::isfinite(x)) return false;
    }
  }
  if (!is_valid(ray)) return false;
  const auto solution = solve(ray, triangle);
  if (!solution) return false;
  const auto& [t, u, v] = *solution;
  const bool after_start = std::isinf(ray.tmin) ? ray.tmin < 0 : t > Rational(ray.tmin);
  const bool before_end = std::isinf(ray.tmax) ? ray.tmax > 0 : t < Rational(ray.tmax);
  return u >= 0 && v >= 0 && u + v <= 1 && after_start && before_end;
}

TEST(ExactHit, AgreesWithRationalElimination) {
  const std::size_t count = test_rays(200);
  for (const cases::Case& c : cases::small_cases()) {
    if (c.is_variant) continue;
    for (std::uint64_t seed = 40; seed < 42; ++seed) {
      SCOPED_TRACE(testing::Message() << c.name << " seed " << seed);
      const cases::CaseData data = c.make(seed, count);
      if (data.triangles.empty()) continue;
      cases::Random random(seed);
      for (const Ray& ray : data.rays) {
        const Triangle& triangle = data.triangles[random.below(data.triangles.size())];
        ASSERT_EQ(exact_hit(ray, triangle.v), hit_by_elimination(ray, triangle));
        // Most random pairs miss; aiming at the triangle's own corner or edge makes the hard ones.
        Ray aimed = ray;
        const std::size_t corner = random.below(3);
        for (std::size_t k = 0; k < 3; ++k) aimed.direction[k] = triangle.v[corner][k] - aimed.origin[k];
        ASSERT_EQ(exact_hit(aimed, triangle.v), hit_by_elimination(aimed, triangle));
      }
    }
  }
}

}  // namespace
}  // namespace umbrix::oracle
