// SPDX-License-Identifier: Apache-2.0
// The stages of the exact test against rationals, each on its own: double must never be wrong when it decides, and the
// integers never at all.

#include "core/triangle_test.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <random>

namespace umbrix::detail {
namespace {

using Rational = boost::multiprecision::cpp_rational;

struct RationalVec {
  Rational x, y, z;
  explicit RationalVec(const float* p) : x(p[0]), y(p[1]), z(p[2]) {}
  explicit RationalVec(const Vec3& p) : x(p.x), y(p.y), z(p.z) {}
  RationalVec(Rational a, Rational b, Rational c) : x(std::move(a)), y(std::move(b)), z(std::move(c)) {}
};
RationalVec operator-(const RationalVec& a, const RationalVec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
RationalVec cross(const RationalVec& a, const RationalVec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Rational dot(const RationalVec& a, const RationalVec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

struct Truth {
  bool hit = false;
  Rational t;
};

/// Solves o + t d = v0 + u e1 + v e2 by the plane's normal, unlike the code under test.
Truth truth(const Ray& ray, const Triangle& triangle) {
  const RationalVec v0(triangle.v[0]), v1(triangle.v[1]), v2(triangle.v[2]), o(ray.origin), d(ray.direction);
  const RationalVec n = cross(v1 - v0, v2 - v0);
  const Rational slope = dot(n, d);
  if (slope == 0) return {};
  Truth result;
  result.t = dot(n, v0 - o) / slope;
  const RationalVec p(o.x + result.t * d.x, o.y + result.t * d.y, o.z + result.t * d.z);
  const RationalVec corners[3] = {v0, v1, v2};
  for (int k = 0; k < 3; ++k)
    if (dot(cross(corners[(k + 1) % 3] - corners[k], p - corners[k]), n) < 0) return result;
  result.hit = (std::isinf(ray.tmin) ? ray.tmin < 0 : result.t > Rational(ray.tmin)) &&
               (std::isinf(ray.tmax) ? ray.tmax > 0 : result.t < Rational(ray.tmax));
  return result;
}

struct Ignore {
  void double_test() {}
  void exact_test() {}
};

/// Pairs that are hard in many ways: aimed at vertices, edges and grid points, at any scale, with ends at the hit.
class Pairs {
 public:
  explicit Pairs(unsigned seed) : random_(seed) {}

  void next(Ray& ray, Triangle& triangle) {
    const int kind = integer(0, 7);
    const bool grid = kind == 0 || kind == 1;
    const float scale = kind == 2 ? std::ldexp(1.0f, integer(-120, 100)) : 1;
    for (Vec3& v : triangle.v) v = point(grid) * scale;
    if (kind == 3) triangle.v[2] = triangle.v[0] + (triangle.v[1] - triangle.v[0]) * 0.5f + point(false) * 1e-6f;
    if (kind == 4) triangle.v[2] = triangle.v[0] + (triangle.v[1] - triangle.v[0]) * 0.5f;
    const Vec3 origin = point(grid) * scale * (kind == 5 ? 1e6f : 1.0f);
    Vec3 target = point(grid) * scale;
    const int aim = integer(0, 4);
    if (aim == 0) target = triangle.v[integer(0, 2)];
    if (aim == 1) target = (triangle.v[0] + triangle.v[1]) * 0.5f;
    if (aim == 2) target = (triangle.v[0] + triangle.v[1] + triangle.v[2]) / 3.0f;
    Vec3 direction = target - origin;
    if (kind == 6) direction[integer(0, 2)] = integer(0, 1) ? 0.0f : -0.0f;
    if (kind == 7) direction *= std::ldexp(1.0f, integer(-100, 60));
    for (int k = 0; k < 3; ++k) {
      ray.origin[k] = origin[k];
      ray.direction[k] = direction[k];
    }
    const float ends[] = {0, 1, 0.5f, std::nextafter(1.0f, 2.0f), INFINITY, 1e-40f, 2};
    ray.tmin = integer(0, 3) == 0 ? -ends[integer(0, 6)] : 0;
    ray.tmax = ends[integer(1, 6)];
  }

 private:
  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  Vec3 point(bool grid) {
    if (grid) return Vec3(integer(-4, 4), integer(-4, 4), integer(-4, 4));
    std::uniform_real_distribution<float> u(-1, 1);
    return {u(random_), u(random_), u(random_)};
  }

  std::mt19937 random_;
};

TEST(TriangleTest, EveryStageAgreesWithRationalsWhereItDecides) {
  constexpr unsigned kSeed = 20190601;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  Pairs pairs(kSeed);
  int hit_count = 0, undecided = 0;
  for (int i = 0; i < 40000; ++i) {
    Ray ray;
    Triangle triangle;
    pairs.next(ray, triangle);
    const bool expected = truth(ray, triangle).hit;
    const DoubleTest in_double = test_in_double(ray, triangle);
    if (in_double.verdict == Verdict::undecided)
      ++undecided;
    else
      ASSERT_EQ(in_double.verdict == Verdict::hit, expected) << "pair " << i;
    ASSERT_EQ(hits_exactly(ray, triangle), expected) << "pair " << i;
    hit_count += expected;
  }
  EXPECT_GT(hit_count, 5000);
  EXPECT_GT(undecided, 2000);
}

TEST(TriangleTest, HitsAreOrderedByTheirTrueDistance) {
  constexpr unsigned kSeed = 7;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  Pairs pairs(kSeed);
  std::mt19937 random(kSeed);
  int ties = 0, compared = 0;
  for (int i = 0; i < 60000; ++i) {
    Ray ray;
    Triangle a, b;
    pairs.next(ray, a);
    // The second triangle shares a vertex with the first, lies in its plane, or is nearly the same.
    b = a;
    const int kind = static_cast<int>(random() % 3);
    if (kind == 0) b.v[1] = a.v[2], b.v[2] = a.v[1];
    if (kind == 1) b.v[1] = a.v[0] + (a.v[1] - a.v[0]) * 2.0f;
    if (kind == 2) b.v[2].x = std::nextafter(b.v[2].x, 10.0f);
    OrderedHit hit_a, hit_b;
    Ignore ignore;
    if (!hits(ray, a, hit_a, ignore) || !hits(ray, b, hit_b, ignore)) continue;
    const Rational t_a = truth(ray, a).t, t_b = truth(ray, b).t;
    const bool expected = t_a != t_b ? t_a < t_b : true;
    ASSERT_EQ(comes_before(ray, hit_a, a, 3, hit_b, b, 4), expected) << "pair " << i;
    EXPECT_LE(Rational(hit_a.t_low), t_a);
    EXPECT_GE(Rational(hit_a.t_high), t_a);
    ties += t_a == t_b;
    ++compared;
  }
  EXPECT_GT(ties, 1000);
  EXPECT_GT(compared - ties, 1000);
}

TEST(TriangleTest, ZeroAreaIsDecidedExactly) {
  const auto triangle = [](Vec3 a, Vec3 b, Vec3 c) { return Triangle{{a, b, c}}; };
  EXPECT_TRUE(is_degenerate(triangle({1, 2, 3}, {1, 2, 3}, {4, 5, 6})));
  EXPECT_TRUE(is_degenerate(triangle({0, 0, 0}, {1, 2, 3}, {2, 4, 6})));
  EXPECT_TRUE(is_degenerate(triangle({1e30f, 0, 0}, {1e30f, 1, 0}, {1e30f, 2, 0})));
  EXPECT_FALSE(is_degenerate(triangle({0, 0, 0}, {1, 2, 3}, {2, 4, std::nextafter(6.0f, 7.0f)})));
  EXPECT_FALSE(is_degenerate(triangle({0, 0, 0}, {1e-45f, 0, 0}, {0, 1e-45f, 0})));
  EXPECT_FALSE(is_degenerate(triangle({1e30f, 0, 0}, {1e30f, 1e-30f, 0}, {1e30f, 0, 1e-30f})));
}

}  // namespace
}  // namespace umbrix::detail
