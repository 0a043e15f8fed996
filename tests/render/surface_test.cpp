// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "built_scenes.h"
#include "traced.h"

namespace umbrix::render {
namespace {

/// Wide enough for products of three differences of floats, whatever their sizes here.
using Exact =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<600, boost::multiprecision::digit_base_2>>;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A quad whose normals lean towards +x.
io::Mesh leaning_quad() {
  io::Mesh mesh = quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  mesh.normals.assign(4, {0.6f, 0, 0.8f});
  return mesh;
}

Surface look(const World& world, const Ray& ray) {
  Hit hit;
  EXPECT_TRUE(world.scene.closest(ray, hit));
  return surface_at(world, ray, hit);
}

void expect_near(const Vec3& actual, const Vec3& expected) {
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(actual[axis], expected[axis], 1e-6) << "axis " << axis;
}

TEST(Surface, NormalsFaceTheViewerFromEitherSide) {
  io::SceneFile scene = scene_of(leaning_quad());
  place(scene, 0);
  World world;
  ASSERT_TRUE(build_world(scene, {}, world).ok());
  const Surface above = look(world, {{0.3f, 0.6f, 2}, 0, {0, 0, -1}, kInfinity});
  expect_near(above.geometric_normal, {0, 0, 1});
  expect_near(above.shading_normal, {0.6, 0, 0.8});
  const Surface below = look(world, {{0.3f, 0.6f, -2}, 0, {0, 0, 1}, kInfinity});
  expect_near(below.geometric_normal, {0, 0, -1});
  expect_near(below.shading_normal, {-0.6, 0, -0.8});
}

TEST(Surface, MirroredInstanceMirrorsItsNormals) {
  io::SceneFile scene = scene_of(leaning_quad());
  place(scene, 0, {{{-1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}});
  World world;
  ASSERT_TRUE(build_world(scene, {}, world).ok());
  const Surface above = look(world, {{-0.3f, 0.6f, 2}, 0, {0, 0, -1}, kInfinity});
  expect_near(above.geometric_normal, {0, 0, 1});
  expect_near(above.shading_normal, {-0.6, 0, 0.8});
}

TEST(Surface, StretchedInstanceKeepsNormalsPerpendicular) {
  // A slope x = z, stretched to x = 4 z: the normal of the stretched plane, not the stretched normal.
  io::Mesh slope = quad({0, 0, 0}, {1, 0, 1}, {1, 1, 1}, {0, 1, 0});
  slope.normals.assign(4, {-std::sqrt(0.5f), 0, std::sqrt(0.5f)});
  io::SceneFile scene = scene_of(slope);
  place(scene, 0, {{{4, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}});
  World world;
  ASSERT_TRUE(build_world(scene, {}, world).ok());
  const Surface surface = look(world, {{2, 0.5f, 5}, 0, {0, 0, -1}, kInfinity});
  expect_near(surface.shading_normal, surface.geometric_normal);
}

TEST(Surface, ErrorBoundReachesThePlaneAndTheOriginIsInFront) {
  const std::uint32_t seed = 20;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(-1, 1);
  for (int i = 0; i < 2000; ++i) {
    const float scale = std::pow(10.0f, 6 * unit(random));
    // Some triangles have corners of very different sizes: a large floor seen near the origin.
    const auto vertex = [&]() -> io::Float3 {
      const float far = i % 2 == 0 ? 1 : std::pow(10.0f, 6 + 6 * unit(random));
      return {scale * far * (3 + unit(random)), scale * far * (-5 + unit(random)), scale * far * unit(random)};
    };
    io::Mesh mesh;
    mesh.positions = {vertex(), vertex(), vertex()};
    mesh.triangles = {{0, 1, 2}};
    io::SceneFile scene = scene_of(mesh);
    place(scene, 0);
    World world;
    world.file = &scene;
    ASSERT_TRUE(flatten(scene, world.meshes, world.notes).ok());

    Hit hit;
    hit.primitive = {0, 0};
    hit.u = 0.5f * std::abs(unit(random));
    hit.v = 0.5f * std::abs(unit(random));
    const Ray ray = {{0, 0, 100 * scale}, 0, {unit(random), unit(random), -1}, kInfinity};
    const Surface surface = surface_at(world, ray, hit);

    // The signed distance, times the normal's length, without rounding.
    const auto above_plane = [&](const Vec3& p) {
      Exact a[3], b[3], d[3];
      for (std::size_t k = 0; k < 3; ++k) {
        a[k] = Exact(mesh.positions[1][k]) - mesh.positions[0][k];
        b[k] = Exact(mesh.positions[2][k]) - mesh.positions[0][k];
        d[k] = Exact(p[static_cast<int>(k)]) - mesh.positions[0][k];
      }
      return Exact(d[0] * (a[1] * b[2] - a[2] * b[1]) + d[1] * (a[2] * b[0] - a[0] * b[2]) +
                   d[2] * (a[0] * b[1] - a[1] * b[0]));
    };
    const Vec3 p0 = to_vec3(mesh.positions[0]), p1 = to_vec3(mesh.positions[1]), p2 = to_vec3(mesh.positions[2]);
    const Vec3 cross = glm::cross(p1 - p0, p2 - p0);
    EXPECT_LE(abs(above_plane(surface.point)), Exact(glm::dot(glm::abs(cross), surface.point_error)));

    Arrival arrival;
    arrival.to_light = surface.geometric_normal;
    const Ray shadow = shadow_ray(receiver_at(surface), arrival);
    const bool upward = glm::dot(cross, surface.geometric_normal) > 0;
    const Exact height = above_plane(Vec3(shadow.origin[0], shadow.origin[1], shadow.origin[2]));
    EXPECT_GT(upward ? height : -height, 0);
  }
}

TEST(Surface, NeedleWhoseAreaDoublesCannotHoldFacesTheViewer) {
  // Not degenerate, but in double its edges are parallel.
  io::Mesh mesh;
  mesh.positions = {{0x1p-60f, 0, 0}, {1, 1, 0}, {2, 2, 0}};
  mesh.triangles = {{0, 1, 2}};
  io::SceneFile scene = scene_of(mesh);
  place(scene, 0);
  World world;
  ASSERT_TRUE(build_world(scene, {}, world).ok());
  const Surface surface = look(world, {{1, 1, 3}, 0, {0, 0, -1}, kInfinity});
  expect_near(surface.point, {1, 1, 0});
  expect_near(surface.geometric_normal, {0, 0, 1});
  expect_near(surface.shading_normal, {0, 0, 1});
}

}  // namespace
}  // namespace umbrix::render
