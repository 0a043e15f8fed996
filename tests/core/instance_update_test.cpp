// SPDX-License-Identifier: Apache-2.0
// Scene::update: a scene that moved answers as one that was built so, bit for bit.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "umbrix/umbrix.h"

namespace umbrix {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

using Floats = std::vector<float>;

/// A crowd of triangles, each of three vertices of its own, around the origin.
Floats cloud(std::mt19937& random, std::size_t triangles) {
  std::uniform_real_distribution<float> anywhere(-1, 1), near(-0.2f, 0.2f);
  Floats out;
  for (std::size_t i = 0; i < triangles; ++i) {
    const float centre[] = {anywhere(random), anywhere(random), anywhere(random)};
    for (int v = 0; v < 3; ++v)
      for (const float c : centre) out.push_back(c + near(random));
  }
  return out;
}

MeshView view_of(const Floats& vertices) {
  MeshView mesh;
  mesh.vertices = vertices.data();
  mesh.vertex_count = vertices.size() / 3;
  mesh.triangle_count = vertices.size() / 9;
  return mesh;
}

struct Place {
  double to_world[3][4];
};

Place anywhere(std::mt19937& random) {
  std::uniform_real_distribution<double> entry(-1, 1), far(-4, 4);
  Place place{};
  for (auto& row : place.to_world) {
    for (double& x : row) x = entry(random);
    row[3] = far(random);
  }
  return place;
}

/// What a scene is made of: a mesh, then instances of two prototypes in turn.
struct Parts {
  Floats mesh, prototypes[2];
  std::vector<Place> places;
};

Parts parts_of(std::mt19937& random) {
  Parts parts;
  parts.mesh = cloud(random, 300);
  for (Floats& prototype : parts.prototypes) prototype = cloud(random, 100);
  for (int i = 0; i < 12; ++i) parts.places.push_back(anywhere(random));
  return parts;
}

void build(const Parts& parts, Scene& scene) {
  ASSERT_TRUE(scene.add(view_of(parts.mesh)).ok());
  for (const Floats& prototype : parts.prototypes) ASSERT_TRUE(scene.add_prototype(view_of(prototype)).ok());
  for (std::size_t i = 0; i < parts.places.size(); ++i) {
    Instance instance;
    instance.prototype = i % 2;
    std::memcpy(instance.to_world, parts.places[i].to_world, sizeof instance.to_world);
    ASSERT_TRUE(scene.add_instance(instance).ok());
  }
  ASSERT_TRUE(scene.commit().ok());
  ASSERT_EQ(scene.build_stats().instances, parts.places.size());
}

SceneUpdate::Move move_to(std::size_t instance, const Place& place) {
  SceneUpdate::Move move;
  move.mesh = static_cast<std::uint32_t>(instance + 1);  // after the mesh
  std::memcpy(move.to_world, place.to_world, sizeof move.to_world);
  return move;
}

SceneUpdate update_of(const std::vector<SceneUpdate::Move>& moves,
                      const std::vector<SceneUpdate::Reshape>& shapes = {}) {
  SceneUpdate update;
  update.moves = moves.data();
  update.move_count = moves.size();
  update.shapes = shapes.data();
  update.shape_count = shapes.size();
  return update;
}

std::vector<Ray> rays_through(std::mt19937& random, std::size_t count) {
  std::uniform_real_distribution<float> far(-6, 6);
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const Ray ray = {{far(random), far(random), far(random)}, 0, {far(random), far(random), far(random)}, kInfinity};
    rays.push_back(ray);
  }
  return rays;
}

void expect_equal_answers(const Scene& a, const Scene& b, std::mt19937& random) {
  const std::vector<Ray> rays = rays_through(random, 3000);
  std::size_t hits = 0;
  for (const Ray& ray : rays) {
    Hit hit_a, hit_b;
    const bool found = a.closest(ray, hit_a);
    ASSERT_EQ(found, b.closest(ray, hit_b));
    ASSERT_EQ(a.occluded(ray), found);
    hits += found;
    if (!found) continue;
    ASSERT_EQ(hit_a.t, hit_b.t);
    ASSERT_EQ(hit_a.u, hit_b.u);
    ASSERT_EQ(hit_a.v, hit_b.v);
    ASSERT_EQ(hit_a.primitive.mesh, hit_b.primitive.mesh);
    ASSERT_EQ(hit_a.primitive.triangle, hit_b.primitive.triangle);
  }
  EXPECT_GT(hits, 50u);
  EXPECT_LT(hits, rays.size());
  float lower[2][3], upper[2][3];
  ASSERT_TRUE(a.bounds(lower[0], upper[0]) && b.bounds(lower[1], upper[1]));
  EXPECT_EQ(std::memcmp(lower[0], lower[1], sizeof lower[0]), 0);
  EXPECT_EQ(std::memcmp(upper[0], upper[1], sizeof upper[0]), 0);
}

TEST(SceneUpdate, AMovedSceneAnswersAsOneThatWasBuiltSo) {
  const std::uint32_t seed = std::random_device{}();
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  Parts parts = parts_of(random);
  Scene moved;
  build(parts, moved);
  for (int step = 0; step < 4; ++step) {
    SCOPED_TRACE(step);
    // Some go elsewhere; from the second step on a prototype becomes another, of another size.
    std::vector<SceneUpdate::Move> moves;
    std::vector<SceneUpdate::Reshape> shapes;
    for (std::size_t i = 0; i < parts.places.size(); ++i) {
      if (i % 3 == 0) parts.places[i] = anywhere(random);
      if (i % 3 == 0 || (step > 0 && i % 2 == 1)) moves.push_back(move_to(i, parts.places[i]));
    }
    if (step > 0) {
      parts.prototypes[1] = cloud(random, 40 + 100 * static_cast<std::size_t>(step));
      shapes.push_back({1, view_of(parts.prototypes[1])});
    }
    const Status status = moved.update(update_of(moves, shapes));
    ASSERT_TRUE(status.ok()) << status.message();
    Scene fresh;
    build(parts, fresh);
    expect_equal_answers(moved, fresh, random);
  }
}

TEST(SceneUpdate, WhatCannotBeLeavesTheSceneAsItWas) {
  std::mt19937 random(1);
  const Parts parts = parts_of(random);
  Scene scene, same;
  build(parts, scene);
  build(parts, same);
  const Place place = anywhere(random);
  Place flat = place;
  for (double& x : flat.to_world[2]) x = 0;
  const Floats shape = cloud(random, 10);
  const std::vector<SceneUpdate::Reshape> shapes = {{0, view_of(shape)}};
  const auto refused = [&](const SceneUpdate& update) { return scene.update(update).code(); };
  SceneUpdate::Move of_the_mesh = move_to(0, place), beyond = of_the_mesh;
  of_the_mesh.mesh = 0;
  beyond.mesh = 99;
  for (const SceneUpdate::Move& last : {of_the_mesh, beyond, move_to(1, flat)}) {
    EXPECT_EQ(refused(update_of({move_to(0, place), last})), StatusCode::invalid_argument) << last.mesh;
  }
  EXPECT_EQ(refused(update_of({move_to(0, place)}, shapes)), StatusCode::invalid_argument) << "others need a move too";
  const std::vector<SceneUpdate::Reshape> unknown = {{9, view_of(shape)}};
  EXPECT_EQ(refused(update_of({}, unknown)), StatusCode::invalid_argument);
  MeshView broken = view_of(shape);
  broken.vertex_count = 2;
  const std::vector<SceneUpdate::Reshape> bad = {{0, broken}};
  EXPECT_EQ(refused(update_of({}, bad)), StatusCode::invalid_argument);
  expect_equal_answers(scene, same, random);
  Scene empty;
  EXPECT_EQ(empty.update({}).message(), "scene: not committed");
}

TEST(SceneUpdate, APrototypeWithAPlacedCopyKeepsItsShape) {
  std::mt19937 random(2);
  const Floats shape = cloud(random, 20), other = cloud(random, 20);
  Scene scene;
  std::uint32_t prototype = 0;
  ASSERT_TRUE(scene.add_prototype(view_of(shape), &prototype).ok());
  Instance instance, flat;
  instance.prototype = flat.prototype = prototype;
  flat.to_world[2][2] = 0;  // has no inverse: added as a mesh
  ASSERT_TRUE(scene.add_instance(instance).ok());
  ASSERT_TRUE(scene.add_instance(flat).ok());
  ASSERT_TRUE(scene.commit().ok());
  ASSERT_EQ(scene.build_stats().instances, 1u);
  SceneUpdate::Move stay;
  const std::vector<SceneUpdate::Reshape> shapes = {{prototype, view_of(other)}};
  const Status status = scene.update(update_of({stay}, shapes));
  EXPECT_EQ(status.message(), "scene: not all instances of the prototype have stayed such");
  EXPECT_TRUE(scene.update(update_of({stay})).ok());
}

TEST(SceneUpdate, AFrameTracerGoesOn) {
  const std::uint32_t seed = std::random_device{}();
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  Parts parts = parts_of(random);
  Scene scene;
  build(parts, scene);
  FrameTracer tracer;
  ASSERT_TRUE(tracer.start(scene).ok());
  const std::vector<Ray> rays = rays_through(random, 1024);
  for (int frame = 0; frame < 4; ++frame) {
    std::vector<SceneUpdate::Move> moves;
    for (std::size_t i = 0; i < parts.places.size(); ++i) {
      parts.places[i] = anywhere(random);
      moves.push_back(move_to(i, parts.places[i]));
    }
    ASSERT_TRUE(scene.update(update_of(moves)).ok());
    Scene fresh;
    build(parts, fresh);
    FrameView view;
    view.frame = frame;
    ASSERT_TRUE(tracer.begin_frame(view).ok());
    ShadowTile tile;
    tile.rays = {rays.data(), rays.size(), sizeof(Ray)};
    std::vector<std::uint8_t> out(rays.size(), 2), wanted(rays.size(), 3);
    tracer.occluded(tile, out.data());
    (void)tracer.end_frame();
    fresh.occluded(tile.rays, wanted.data());
    EXPECT_EQ(out, wanted) << "frame " << frame;
  }
}

}  // namespace
}  // namespace umbrix
