// SPDX-License-Identifier: Apache-2.0
#include "render/world.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "built_scenes.h"

namespace umbrix::render {
namespace {

const io::Mesh kUnitQuad = quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});

/// A rotation by 0.7 about z, scaled, moved: nothing in it is exact in float.
io::Transform skewed() {
  const double c = std::cos(0.7) * 1.1, s = std::sin(0.7) * 1.1;
  return {{{c, -s, 0.3, 1.0 / 3}, {s, c, 0, 1.0 / 7}, {0.1, 0, 2, 1e3}}};
}

std::vector<WorldMesh> flattened(const io::SceneFile& scene, std::vector<std::string>* notes = nullptr) {
  std::vector<WorldMesh> meshes;
  std::vector<std::string> said;
  const Status status = flatten(scene, meshes, said);
  EXPECT_TRUE(status.ok()) << status.message();
  if (notes) *notes = said;
  return meshes;
}

TEST(World, PositionsAreRoundedOnceFromDouble) {
  io::SceneFile scene = scene_of(kUnitQuad);
  place(scene, 0, skewed());
  const io::Transform m = skewed();
  const io::Float3 corner = flattened(scene)[0].positions[2];
  for (std::size_t row = 0; row < 3; ++row) {
    EXPECT_EQ(corner[row], static_cast<float>(m[row][0] + m[row][1] + m[row][3]));
  }
}

TEST(World, MeshesThatMeetKeepEqualBits) {
  // Two meshes that share the edge x = 1, placed alike.
  io::SceneFile scene = scene_of(kUnitQuad);
  scene.meshes.push_back(quad({1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}));
  place(scene, 0, skewed());
  place(scene, 1, skewed());
  const std::vector<WorldMesh> meshes = flattened(scene);
  EXPECT_EQ(std::memcmp(&meshes[0].positions[1], &meshes[1].positions[0], sizeof(io::Float3)), 0);
  EXPECT_EQ(std::memcmp(&meshes[0].positions[2], &meshes[1].positions[3], sizeof(io::Float3)), 0);
}

TEST(World, MeshesLeadBackToTheirInstances) {
  io::SceneFile scene = scene_of(kUnitQuad);
  scene.meshes.emplace_back();  // without triangles
  place(scene, 1);
  place(scene, 0);
  place(scene, 0);
  const std::vector<WorldMesh> meshes = flattened(scene);
  ASSERT_EQ(meshes.size(), 2u);
  EXPECT_EQ(meshes[0].instance, 1u);
  EXPECT_EQ(meshes[1].instance, 2u);
  EXPECT_EQ(meshes[0].mesh, &scene.meshes[0]);
}

TEST(World, MirroringTransformsAreKnown) {
  io::SceneFile scene = scene_of(kUnitQuad);
  place(scene, 0);
  place(scene, 0, {{{-1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}});
  place(scene, 0, {{{-1, 0, 0, 0}, {0, -1, 0, 0}, {0, 0, 1, 0}}});
  const std::vector<WorldMesh> meshes = flattened(scene);
  EXPECT_FALSE(meshes[0].mirrored);
  EXPECT_TRUE(meshes[1].mirrored);
  EXPECT_FALSE(meshes[2].mirrored);
}

TEST(World, MaskedMeshBelowTheCutOffIsNotThere) {
  io::SceneFile scene = scene_of(kUnitQuad);
  place(scene, 0);
  scene.materials[0].alpha_mode = io::AlphaMode::mask;
  scene.materials[0].alpha = 0.25f;
  scene.materials[0].alpha_cutoff = 0.5f;
  EXPECT_TRUE(flattened(scene).empty());
  scene.materials[0].alpha = 0.5f;  // glTF: not below is opaque
  EXPECT_EQ(flattened(scene).size(), 1u);
}

TEST(World, BlendedMeshSaysSoUnlessItIsNotThere) {
  io::SceneFile scene = scene_of(kUnitQuad);
  place(scene, 0);
  std::vector<std::string> notes;
  EXPECT_EQ(flattened(scene, &notes).size(), 1u);
  EXPECT_TRUE(notes.empty());
  scene.materials[0].alpha_mode = io::AlphaMode::blend;
  scene.materials[0].alpha = 0.5f;
  EXPECT_EQ(flattened(scene, &notes).size(), 1u);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("blended"), std::string::npos);
  scene.materials[0].alpha = 0;
  EXPECT_TRUE(flattened(scene, &notes).empty());
  EXPECT_TRUE(notes.empty());
}

TEST(World, RaysMeetThePlacedTriangles) {
  io::SceneFile scene = scene_of(kUnitQuad);
  place(scene, 0);
  place(scene, 0, {{{1, 0, 0, 10}, {0, 1, 0, 0}, {0, 0, 1, 5}}});
  World world;
  ASSERT_TRUE(build_world(scene, {}, world).ok());
  const Ray ray = {{10.25f, 0.5f, 9}, 0, {0, 0, -1}, std::numeric_limits<float>::infinity()};
  Hit hit;
  ASSERT_TRUE(world.scene.closest(ray, hit));
  EXPECT_EQ(hit.t, 4);
  EXPECT_EQ(world.meshes[hit.primitive.mesh].instance, 1u);
}

TEST(World, WhatMovesIsPlacedAnewAndWhatStaysIsKept) {
  io::SceneFile scene = scene_of(kUnitQuad);
  place(scene, 0);
  place(scene, 0, {{{1, 0, 0, 10}, {0, 1, 0, 0}, {0, 0, 1, 5}}});
  World world;
  ASSERT_TRUE(build_world(scene, {}, world).ok());
  const io::Float3* const still = world.meshes[0].positions.data();
  const auto depth_at = [&](float x) {
    Hit hit;
    const Ray ray = {{x, 0.5f, 9}, 0, {0, 0, -1}, std::numeric_limits<float>::infinity()};
    return world.scene.closest(ray, hit) ? hit.t : -1;
  };

  scene.instances[1].to_world = {{{-1, 0, 0, 20}, {0, 1, 0, 0}, {0, 0, 1, 8}}};
  io::SceneChanges changes;
  bool rebuilt = false;
  ASSERT_TRUE(move_world(changes, {}, world, rebuilt).ok());
  EXPECT_EQ(depth_at(10.25f), 4) << "nothing was said to have moved";
  changes.instances = {1};
  ASSERT_TRUE(move_world(changes, {}, world, rebuilt).ok());
  EXPECT_TRUE(rebuilt);
  EXPECT_EQ(depth_at(10.25f), -1);
  EXPECT_EQ(depth_at(19.25f), 1);
  EXPECT_EQ(depth_at(0.25f), 9);
  EXPECT_TRUE(world.meshes[1].mirrored);
  EXPECT_EQ(world.meshes[0].positions.data(), still);
}

}  // namespace
}  // namespace umbrix::render
