// SPDX-License-Identifier: Apache-2.0
//
// Rays from one point that the default kernel follows in packets: each must meet what it meets alone, whatever is
// asked.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "two_meshes.h"

namespace umbrix::detail {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity(), kNaN = std::numeric_limits<float>::quiet_NaN();

/// Of a pinhole camera, in blocks of 4x4 pixels.
std::vector<Ray> camera_rays(const Vec3& eye, float field, int side = 64) {
  std::vector<Ray> rays;
  for (int i = 0; i < side * side; ++i) {
    const int block = i / 16, x = block % (side / 4) * 4 + i % 4, y = block / (side / 4) * 4 + i / 4 % 4;
    const auto across = [&](int pixel) {
      return field * (2.0f * static_cast<float>(pixel) / static_cast<float>(side) - 1);
    };
    rays.push_back({{eye.x, eye.y, eye.z}, 0, {across(x), across(y), -1}, kInfinity});
  }
  return rays;
}

std::vector<Ray> rays_in_front() { return camera_rays(Vec3(0.1f, 0.05f, 2.5f), 0.5f); }

/// The hits are those of `brute`, bit for bit, on every instruction set.
void expect_hits(const Scene& scene, RaySpan rays, QueryOptions options = {}) {
  std::vector<Hit> truth(rays.count);
  QueryOptions brute = options;
  ASSERT_TRUE(find_kernel("brute", brute.kernel).ok());
  scene.closest(rays, truth.data(), brute);
  std::size_t met = 0;
  for (const Hit& hit : truth) met += hit.valid() ? 1 : 0;
  EXPECT_GT(met, rays.count / 20);
  for (std::size_t target = 0; target < simd_target_count(); ++target) {
    SCOPED_TRACE(simd_target_name(target));
    ASSERT_TRUE(use_simd_target(simd_target_name(target)).ok());
    std::vector<Hit> hits(rays.count);
    scene.closest(rays, hits.data(), options);
    for (std::size_t i = 0; i < rays.count; ++i) {
      ASSERT_EQ(hits[i].primitive.mesh, truth[i].primitive.mesh) << "ray " << i;
      ASSERT_EQ(hits[i].primitive.triangle, truth[i].primitive.triangle) << "ray " << i;
      if (!truth[i].valid()) continue;
      ASSERT_EQ(hits[i].t, truth[i].t) << "ray " << i;
      ASSERT_EQ(hits[i].u, truth[i].u) << "ray " << i;
      ASSERT_EQ(hits[i].v, truth[i].v) << "ray " << i;
    }
  }
  ASSERT_TRUE(use_simd_target(nullptr).ok());
}
void expect_hits(const Scene& scene, const std::vector<Ray>& rays, QueryOptions options = {}) {
  expect_hits(scene, {rays.data(), rays.size()}, options);
}

TEST(ClosestPackets, FromOutsideAndWithin) {
  const TwoMeshes two;
  expect_hits(two.scene, rays_in_front());
  for (const float field : {0.01f, 1.0f, 8.0f}) expect_hits(two.scene, camera_rays(Vec3(0.01f, -0.02f, 0.9f), field));
}

TEST(ClosestPackets, MasksHold) {
  const TwoMeshes two;
  for (const std::uint32_t mask : {1u, 2u}) {
    QueryOptions options;
    options.mask = mask;
    expect_hits(two.scene, rays_in_front(), options);
  }
}

TEST(ClosestPackets, SkippedTrianglesAreNotThere) {
  const TwoMeshes two;
  const std::vector<Ray> rays = rays_in_front();
  const std::vector<Primitive> skip = first_met(two.scene, rays);
  QueryOptions options;
  options.skip = skip.data();
  expect_hits(two.scene, rays, options);
}

TEST(ClosestPackets, OpacityIsAsked) {
  OpacityTest half;
  half.opaque = [](const void*, std::uint32_t triangle, float u, float v) { return triangle % 2 == 0 || u < v; };
  expect_hits(TwoMeshes(half).scene, rays_in_front());
}

TEST(ClosestPackets, AnyIntervalsAndLengths) {
  const TwoMeshes two;
  std::vector<Ray> rays = rays_in_front();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    // Some packets are of one length, some of many.
    const std::size_t choice = i % 3 == 0 ? i / 64 : i;
    const float length = std::ldexp(1.0f, static_cast<int>((i / 1024 % 2 == 0 ? i / 16 : choice) % 41) - 20);
    for (float& x : rays[i].direction) x *= length;
    rays[i].tmax = (i % 2 == 0 ? 2.5f : 3.5f) / length;
    if (i % 5 == 0) rays[i].tmin = 2.4f / length;
    if (i % 97 == 0) rays[i].tmin = -1 / length;
  }
  expect_hits(two.scene, rays);
}

TEST(ClosestPackets, SomeRaysMayBeOdd) {
  const TwoMeshes two;
  std::vector<Ray> rays = rays_in_front();
  const std::function<void(Ray&)> changes[] = {[](Ray& r) { r.origin[1] = kNaN; },
                                               [](Ray& r) { r.direction[0] = kNaN; },
                                               [](Ray& r) { r.tmin = r.tmax; },
                                               [](Ray& r) { r.direction[2] = kInfinity; },
                                               [](Ray& r) { r.tmax = kNaN; },
                                               [](Ray& r) { r.tmin = kNaN; },
                                               [](Ray& r) { std::fill_n(r.direction, 3, 0.0f); },
                                               [](Ray& r) { r.origin[0] += 0.5f; },
                                               [](Ray& r) { r.direction[0] = 1e-42f; },
                                               [](Ray& r) { r.tmin = 1e-42f; }};
  for (std::size_t i = 0; i < rays.size(); i += 37) changes[i / 37 % std::size(changes)](rays[i]);
  expect_hits(two.scene, rays);
}

/// Of squares of two triangles each; its vertices are 9x9.
struct Wall {
  static constexpr int kSide = 9;
  std::vector<float> vertices;
  std::vector<std::uint32_t> indices;

  Wall(float square, float tilt) {
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        for (const int c : {x - 4, y - 4}) vertices.push_back(square * static_cast<float>(c));
        vertices.push_back(tilt * static_cast<float>(2 * x - y));
        if (x + 1 == kSide || y + 1 == kSide) continue;
        const auto v = static_cast<std::uint32_t>(y * kSide + x);
        for (const std::uint32_t i : {v, v + 1, v + kSide, v + 1, v + kSide + 1, v + kSide}) indices.push_back(i);
      }
    }
  }

  MeshView view() const {
    MeshView wall;
    wall.vertices = vertices.data();
    wall.vertex_count = vertices.size() / 3;
    wall.indices = indices.data();
    wall.triangle_count = indices.size() / 3;
    return wall;
  }

  /// Four rays a square and axis, from (1, -2, 16) squares away: to its vertices, the middles of edges and between.
  static std::vector<Ray> rays(float square) {
    std::vector<Ray> result;
    for (int i = 0; i < 40 * 40; ++i) {
      const int block = i / 16, x = block % 10 * 4 + i % 4, y = block / 10 * 4 + i / 4 % 4;
      const float at[2] = {0.25f * static_cast<float>(x) - 4.75f, 0.25f * static_cast<float>(y) - 4.75f};
      result.push_back(
          {{square, -2 * square, 16 * square}, 0, {square * (at[0] - 1), square * (at[1] + 2), -16 * square}, 2});
    }
    return result;
  }
};

TEST(ClosestPackets, EqualDistancesGoToTheTriangleAddedFirst) {
  // Without rounding rays meet up to six triangles of a wall at once.
  for (const auto& [square, tilt] : {std::pair(1.0f, 0.0f), std::pair(0.3f, 0.07f)}) {
    SCOPED_TRACE(square);
    Wall wall(square, tilt), turned = wall;
    for (std::size_t i = 0; i < turned.indices.size(); i += 3)
      std::rotate(&turned.indices[i], &turned.indices[i + 1], &turned.indices[i] + 3);
    Scene scene;
    ASSERT_TRUE(scene.add(wall.view()).ok());
    ASSERT_TRUE(scene.add(turned.view()).ok());  // equal triangles whose arithmetic is another
    ASSERT_TRUE(scene.commit().ok());
    expect_hits(scene, Wall::rays(square));
  }
}

TEST(ClosestPackets, ScenesOfAnySize) {
  for (const int exponent : {-100, -60, -20, 20, 60, 100}) {
    SCOPED_TRACE(exponent);
    std::vector<Triangle> triangles = random_soup(300, 0.2f, 1);
    for (Triangle& t : triangles)
      for (Vec3& v : t.v) v *= std::ldexp(1.0f, exponent);
    Scene scene;
    ASSERT_TRUE(scene.add(view_of(triangles)).ok());
    ASSERT_TRUE(scene.commit().ok());
    for (const int of_directions : {0, exponent}) {
      std::vector<Ray> rays = rays_in_front();
      for (Ray& ray : rays) {
        for (float& x : ray.origin) x = std::ldexp(x, exponent);
        for (float& x : ray.direction) x = std::ldexp(x, of_directions);
      }
      expect_hits(scene, rays);
    }
  }
}

TEST(ClosestPackets, RaysMayLieInLargerThingsAndBeAnyNumber) {
  const TwoMeshes two;
  struct Thing {
    Ray ray;
    char more[20];
  };
  const std::vector<Ray> rays = rays_in_front();
  std::vector<Thing> things(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) things[i].ray = rays[i];
  expect_hits(two.scene, {&things[0].ray, things.size(), sizeof(Thing)});
  const std::size_t half = rays.size() / 2;
  for (const std::size_t count : {21, 31, 45}) expect_hits(two.scene, {&rays[half], count});
}

}  // namespace
}  // namespace umbrix::detail
