// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "umbrix/umbrix.h"

namespace umbrix {
namespace {

/// A square of two triangles in z = 0 from (0, 0) to (1, 1), with the image upright on it.
struct Card {
  std::vector<float> vertices = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  std::vector<float> texcoords = {0, 1, 1, 1, 1, 0, 0, 0};
  std::vector<std::uint32_t> indices = {0, 1, 2, 0, 2, 3};
  std::vector<std::uint8_t> image = {255, 0, 0, 255};
  AlphaMap map;

  Card(const Card&) = delete;  // the map points into it
  Card& operator=(const Card&) = delete;
  Card() {
    map.image = image.data();
    map.width = map.height = 2;
    map.sampler.nearest = true;
    map.texcoords = texcoords.data();
    map.indices = indices.data();
    map.triangle_count = 2;
    map.vertex_count = 4;
  }

  Scene scene(const AlphaTest& test) const {
    MeshView view;
    view.vertices = vertices.data();
    view.vertex_count = 4;
    view.indices = indices.data();
    view.triangle_count = 2;
    view.opacity = test.test();
    Scene made;
    EXPECT_TRUE(made.add(view).ok());
    EXPECT_TRUE(made.commit().ok());
    return made;
  }
};

Ray down(float x, float y) { return {{x, y, 1}, 0, {0, 0, -1}, 2}; }

TEST(AlphaTest, BlocksWhereTheImageIsOpaque) {
  const Card card;
  AlphaTest test;
  ASSERT_TRUE(test.set(card.map).ok());
  const Scene scene = card.scene(test);
  EXPECT_TRUE(scene.occluded(down(0.25f, 0.75f))) << "upper left";
  EXPECT_FALSE(scene.occluded(down(0.75f, 0.75f))) << "upper right";
  EXPECT_FALSE(scene.occluded(down(0.25f, 0.25f))) << "lower left";
  EXPECT_TRUE(scene.occluded(down(0.75f, 0.25f))) << "lower right";
}

TEST(AlphaTest, ATestThatNobodyNeedsIsNone) {
  Card card;
  card.image = {255, 255, 255, 128};
  AlphaTest test;
  ASSERT_TRUE(test.set(card.map).ok());
  EXPECT_EQ(test.test().opaque, nullptr) << "128 of 255 is not below a half";
  EXPECT_EQ(test.opaque_triangles(), 2u);
  card.image[3] = 127;
  ASSERT_TRUE(test.set(card.map).ok());
  EXPECT_NE(test.test().opaque, nullptr);
  card.image = {0, 9, 9, 0};
  ASSERT_TRUE(test.set(card.map).ok());
  EXPECT_EQ(test.transparent_triangles(), 2u);
  EXPECT_FALSE(card.scene(test).occluded(down(0.5f, 0.3f)));
}

TEST(AlphaTest, FactorsVerticesAndTransformsCount) {
  Card card;
  AlphaTest test;
  const std::vector<float> vertex_alpha = {1, 0, 0, 1};
  card.map.image = nullptr;
  card.map.vertex_alpha = vertex_alpha.data();
  card.map.factor = 0.8f;
  ASSERT_TRUE(test.set(card.map).ok());
  EXPECT_NEAR(test.alpha(0, 0.25, 0.25), 0.4, 1e-7);
  const Scene scene = card.scene(test);
  EXPECT_TRUE(scene.occluded(down(0.3f, 0.2f)));
  EXPECT_FALSE(scene.occluded(down(0.4f, 0.2f)));

  Card moved;
  moved.map.transform[0][2] = 0.5;
  ASSERT_TRUE(test.set(moved.map).ok());
  EXPECT_FALSE(moved.scene(test).occluded(down(0.25f, 0.75f)));
  EXPECT_TRUE(moved.scene(test).occluded(down(0.75f, 0.75f)));
}

TEST(AlphaTest, MapsThatDoNotFitAreRefused) {
  AlphaTest test;
  const auto refused = [&](const AlphaMap& map, const char* said) {
    const Status status = test.set(map);
    EXPECT_EQ(status.code(), StatusCode::invalid_argument);
    EXPECT_NE(status.message().find(said), std::string::npos) << status.message();
    EXPECT_EQ(test.test().opaque, nullptr);
  };
  const Card whole;
  AlphaMap map = whole.map;
  map.width = 0;
  refused(map, "empty");
  map = whole.map;
  map.texcoords = nullptr;
  refused(map, "texture coordinates");
  map = whole.map;
  map.vertex_count = 3;
  refused(map, "vertex 3 of 3");
  map = whole.map;
  map.texcoord_stride = 9;
  refused(map, "strides");
}

/// What is told of whole triangles agrees with a look at any of their points.
TEST(AlphaTest, WholeTrianglesAreAsTheirPoints) {
  const std::uint32_t seed = 31;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  const auto below = [&](int limit) { return std::uniform_int_distribution<int>(0, limit - 1)(random); };
  std::uniform_real_distribution<float> unit(0, 1);
  std::size_t whole = 0, all = 0;
  for (int round = 0; round < 2000; ++round) {
    // Patches of alpha, so that there are triangles of all kinds.
    const auto width = static_cast<std::uint32_t>(1 + below(90)), height = static_cast<std::uint32_t>(1 + below(90));
    std::vector<std::uint8_t> image(std::size_t{width} * height);
    const std::uint32_t patch = 1u << below(6);
    const auto values = static_cast<std::uint32_t>(below(1000));
    for (std::uint32_t i = 0; i < image.size(); ++i) {
      const std::uint32_t number = i % width / patch * 7 + i / width / patch * 13 + values;
      image[i] = number % 3 == 0 ? 255 : number % 3 == 1 ? 0 : static_cast<std::uint8_t>(number * 37 % 256);
    }
    const float size = std::exp2(static_cast<float>(below(8) - 5));
    std::vector<float> texcoords;
    for (int i = 0; i < 60; ++i) {
      if (i % 6 < 2) {
        texcoords.push_back(6 * unit(random) - 3);
      } else {
        texcoords.push_back(texcoords[texcoords.size() - 2] + size * (unit(random) - 0.5f));
      }
    }
    AlphaMap map;
    map.image = image.data();
    map.width = width;
    map.height = height;
    map.sampler = {static_cast<Wrap>(below(3)), static_cast<Wrap>(below(3)), below(2) == 0};
    map.texcoords = texcoords.data();
    map.triangle_count = 10;
    map.vertex_count = 30;
    map.stochastic = below(2) == 0;
    map.factor = below(2) == 0 ? 1 : 0.75f;
    map.cutoff = below(4) == 0 ? 1 : unit(random);
    AlphaTest test;
    ASSERT_TRUE(test.set(map).ok());
    whole += test.opaque_triangles() + test.transparent_triangles();
    all += 10;
    const OpacityTest opacity = test.test();
    for (std::uint32_t t = 0; t < 10; ++t) {
      for (int i = 0; i < 30; ++i) {
        float u = unit(random), v = unit(random);
        if (u + v > 1) u = 1 - u, v = 1 - v;
        const double alpha = test.alpha(t, static_cast<double>(u), static_cast<double>(v));
        const bool blocks = !opacity.opaque || opacity.opaque(opacity.user, t, u, v);
        const bool enough = alpha >= static_cast<double>(map.cutoff);
        EXPECT_TRUE(blocks || !(map.stochastic ? alpha >= 1 : enough)) << alpha;
        EXPECT_TRUE(!blocks || (map.stochastic ? alpha > 0 : enough)) << alpha;
      }
      ASSERT_FALSE(::testing::Test::HasFailure()) << "round " << round << " triangle " << t;
    }
  }
  EXPECT_GT(whole, all / 10) << "else this tests nothing";
  EXPECT_LT(whole, all * 9 / 10);
}

/// The share of rays that a sheet of a constant alpha stops is that alpha, by the law of large numbers.
TEST(AlphaTest, StochasticSheetsStopTheirShareOfRays) {
  Card card;
  card.map.image = nullptr;
  card.map.stochastic = true;
  constexpr int kRays = 40000;
  for (const float alpha : {0.1f, 0.5f, 0.75f}) {
    card.map.factor = alpha;
    for (const std::uint64_t seed : {0, 1, 77}) {
      card.map.seed = seed;
      AlphaTest test;
      ASSERT_TRUE(test.set(card.map).ok());
      const Scene scene = card.scene(test);
      int stopped = 0, neighbours_alike = 0;
      bool last = false;
      for (int i = 0; i < kRays; ++i) {
        // A regular grid, as pixels make it.
        const bool now = scene.occluded(
            down((static_cast<float>(i % 200) + 0.5f) / 200, (static_cast<float>(i / 200) + 0.25f) / 200));
        stopped += now;
        neighbours_alike += now == last;
        last = now;
      }
      const auto a = static_cast<double>(alpha);
      EXPECT_NEAR(stopped, kRays * a, 5 * std::sqrt(kRays * a * (1 - a))) << alpha << ", seed " << seed;
      const double alike = a * a + (1 - a) * (1 - a);
      EXPECT_NEAR(neighbours_alike, kRays * alike, 7 * std::sqrt(kRays * alike * (1 - alike))) << alpha;
    }
  }
}

TEST(AlphaTest, SeedsTellSheetsApart) {
  Card card;
  card.map.image = nullptr;
  card.map.stochastic = true;
  card.map.factor = 0.5f;
  AlphaTest tests[2];
  for (std::uint64_t seed = 0; seed < 2; ++seed) {
    card.map.seed = seed;
    ASSERT_TRUE(tests[seed].set(card.map).ok());
  }
  int alike = 0;
  for (int i = 0; i < 10000; ++i) {
    const float u = static_cast<float>(i % 100) / 200, v = static_cast<float>(i / 100) / 200;
    const OpacityTest a = tests[0].test(), b = tests[1].test();
    EXPECT_EQ(a.opaque(a.user, 1, u, v), a.opaque(a.user, 1, u, v));
    alike += a.opaque(a.user, 0, u, v) == b.opaque(b.user, 0, u, v);
  }
  EXPECT_NEAR(alike, 5000, 300);
}

}  // namespace
}  // namespace umbrix
