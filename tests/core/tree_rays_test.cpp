// SPDX-License-Identifier: Apache-2.0
// Rays made from the planes of the very tree they will walk: in its split planes, along cell edges, from corner to
// corner, with ends at plane times. Each of them puts the walk's rounding to the test; every kernel must answer as if
// there were no tree, and two of them on every instruction set.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "core/exact_test.h"
#include "tree/builder.h"
#include "umbrix/umbrix.h"

namespace umbrix {
namespace {

struct World {
  const char* name;
  std::vector<detail::Triangle> triangles;
};

std::vector<detail::Triangle> soup(std::size_t count, float size, const detail::Vec3& offset, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> u(-1, 1);
  std::vector<detail::Triangle> result(count);
  for (detail::Triangle& t : result) {
    const detail::Vec3 center(u(random), u(random), u(random));
    for (detail::Vec3& v : t.v) v = offset + center + size * detail::Vec3(u(random), u(random), u(random));
  }
  return result;
}

/// Floors and walls of unit squares, whose planes and corners are those of the cells.
std::vector<detail::Triangle> rooms(int side) {
  std::vector<detail::Triangle> result;
  const auto square = [&](detail::Vec3 o, detail::Vec3 a, detail::Vec3 b) {
    result.push_back({{o, o + a, o + a + b}});
    result.push_back({{o, o + a + b, o + b}});
  };
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y)
      for (int z = 0; z < side; ++z) {
        if ((x + 2 * y + 3 * z) % 4 == 0) square({x, y, z}, {1, 0, 0}, {0, 1, 0});
        if ((3 * x + y + z) % 5 == 0) square({x, y, z}, {0, 1, 0}, {0, 0, 1});
      }
  return result;
}

/// The tree's planes by axis, in the scene's units.
std::array<std::vector<float>, 3> planes_of(const std::vector<detail::Triangle>& triangles) {
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
    if (!detail::is_degenerate(triangles[i])) kept.push_back(i);
  BuildStats stats;
  const detail::Tree tree = detail::build_tree(triangles, kept, BuildQuality::high, nullptr, stats);
  std::array<std::vector<float>, 3> planes;
  for (int axis = 0; axis < 3; ++axis)
    for (const float root : {tree.root.lower[axis], tree.root.upper[axis]})
      planes[static_cast<std::size_t>(axis)].push_back(std::ldexp(root, -tree.scale_exponent));
  std::vector<std::uint32_t> open{0};
  while (!open.empty()) {
    const detail::Node node = tree.nodes[open.back()];
    open.pop_back();
    if (node.is_leaf()) continue;
    planes[node.axis_bits()].push_back(std::ldexp(node.plane(), -tree.scale_exponent));
    open.push_back(node.low_child());
    open.push_back(node.low_child() + 1);
  }
  return planes;
}

class RayMaker {
 public:
  RayMaker(const std::vector<detail::Triangle>& triangles, unsigned seed)
      : planes_(planes_of(triangles)), random_(seed) {}

  Ray next() {
    detail::Vec3 from = corner(), to = corner();
    const auto kind = random_() % 6;
    if (kind == 1) to = anywhere();
    if (kind == 2) from = anywhere();
    if (kind == 3) to[axis()] = from[axis_];  // within a plane
    if (kind == 4) {                          // along an edge
      const float keep = to[axis()];
      to = from;
      to[axis_] = keep;
    }
    if (kind == 5) from = from + 4.0f * (from - to);  // from outside
    detail::Vec3 d = to - from;
    if (random_() % 2 == 0 && glm::length(d) > 0) d = glm::normalize(d);
    Ray ray{{from.x, from.y, from.z}, 0, {d.x, d.y, d.z}, random_() % 3 == 0 ? INFINITY : 1.0f};
    // An end at the time of one of the planes.
    const int k = axis();
    if (random_() % 4 == 0 && d[k] != 0) ray.tmax = (corner()[k] - from[k]) / d[k];
    return ray;
  }

 private:
  int axis() { return axis_ = static_cast<int>(random_() % 3); }
  float plane(std::size_t k) { return planes_[k][random_() % planes_[k].size()]; }
  detail::Vec3 corner() { return {plane(0), plane(1), plane(2)}; }
  detail::Vec3 anywhere() {
    std::uniform_real_distribution<float> u(0, 1);
    const detail::Vec3 a = corner(), b = corner();
    return a + u(random_) * (b - a);
  }

  std::array<std::vector<float>, 3> planes_;
  std::mt19937 random_;
  int axis_ = 0;
};

void build(const std::vector<detail::Triangle>& triangles, Scene& scene) {
  MeshView mesh;
  mesh.vertices = &triangles[0].v[0].x;
  mesh.vertex_count = 3 * triangles.size();
  mesh.triangle_count = triangles.size();
  ASSERT_TRUE(scene.add(mesh).ok());
  ASSERT_TRUE(scene.commit().ok());
}

bool is_for_all_targets(const std::string& kernel) {
  return kernel == "auto" || kernel == "standard" || kernel == "linked";
}

void prepare_all(const std::vector<Ray>& rays, Scene& scene) {
  Training training;
  training.rays = {rays.data(), rays.size()};
  for (std::size_t kernel = 0; kernel < kernel_count(); ++kernel)
    ASSERT_TRUE(scene.prepare({static_cast<int>(kernel)}, training).ok());
}

void expect_like_brute(const Scene& scene, const std::vector<Ray>& rays) {
  const RaySpan span{rays.data(), rays.size()};
  QueryOptions options;
  ASSERT_TRUE(find_kernel("brute", options.kernel).ok());
  std::vector<std::uint8_t> expected(rays.size()), answer(rays.size());
  std::vector<Hit> expected_hit(rays.size()), hit(rays.size());
  scene.occluded(span, expected.data(), options);
  scene.closest(span, expected_hit.data(), options);
  for (std::size_t target = 0; target < simd_target_count(); ++target) {
    ASSERT_TRUE(use_simd_target(simd_target_name(target)).ok());
    for (std::size_t kernel = 0; kernel < kernel_count(); ++kernel) {
      const std::string name = kernel_info(kernel).name;
      if (name == "brute" || (target > 0 && !is_for_all_targets(name))) continue;
      SCOPED_TRACE(name + " " + simd_target_name(target));
      options.kernel.index = static_cast<int>(kernel);
      scene.occluded(span, answer.data(), options);
      scene.closest(span, hit.data(), options);
      for (std::size_t i = 0; i < rays.size(); ++i) {
        ASSERT_EQ(answer[i], expected[i]) << "ray " << i;
        ASSERT_EQ(hit[i].primitive.triangle, expected_hit[i].primitive.triangle) << "ray " << i;
        ASSERT_EQ(hit[i].t, expected_hit[i].t) << "ray " << i;
      }
    }
  }
  ASSERT_TRUE(use_simd_target(nullptr).ok());
}

TEST(TreeRays, AreAnsweredAsIfThereWereNoTree) {
  constexpr unsigned kSeed = 2013;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  const World worlds[] = {{"soup", soup(300, 0.2f, detail::Vec3(0), 1)},
                          {"rooms", rooms(6)},
                          {"far from the origin", soup(200, 0.3f, detail::Vec3(300, -700, 90), 2)},
                          {"very far from the origin", soup(200, 0.3f, detail::Vec3(1e4f, 2e4f, -3e4f), 3)}};
  for (const World& world : worlds) {
    SCOPED_TRACE(world.name);
    Scene scene;
    build(world.triangles, scene);
    RayMaker maker(world.triangles, kSeed);
    std::vector<Ray> rays(8000);
    for (Ray& ray : rays) ray = maker.next();
    prepare_all(rays, scene);
    expect_like_brute(scene, rays);
  }
}

}  // namespace
}  // namespace umbrix
