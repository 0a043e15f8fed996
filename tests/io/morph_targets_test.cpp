// SPDX-License-Identifier: Apache-2.0
// Morph targets and their weights, at rest and animated, against values worked out by hand.

#include <gtest/gtest.h>

#include <cmath>

#include "posed_scene.h"

namespace umbrix::io {
namespace {

using namespace testing;

/// A triangle with two morph targets; the second one is sparse and moves the third corner only.
Gltf with_targets() {
  Gltf g;
  const int positions = g.floats3({0, 0, 0, 1, 0, 0, 0, 1, 0}), normals = g.floats3({0, 0, 1, 0, 0, 1, 0, 0, 1});
  const int up = g.floats3({0, 0, 1, 0, 0, 2, 0, 0, 3}), turn = g.floats3({1, 0, -1, 1, 0, -1, 1, 0, -1});
  nlohmann::json sparse = {{"componentType", 5126}, {"count", 3}, {"type", "VEC3"}};
  sparse["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", g.view(bytes_of(std::vector<std::uint16_t>{2}))}, {"componentType", 5123}}},
      {"values", {{"bufferView", g.view(bytes_of(std::vector<float>{0, 4, 0}))}}}};
  g.json["accessors"].push_back(sparse);
  const auto last = g.json["accessors"].size() - 1;
  const int mesh = g.mesh({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}},
                           {"targets", {{{"POSITION", up}, {"NORMAL", turn}}, {{"POSITION", last}}}}});
  g.root({{"mesh", mesh}});
  return g;
}

TEST(MorphTargets, WithoutWeightsTheMeshIsItself) {
  const SceneFile scene = load(with_targets());
  EXPECT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.meshes[0].positions[2], (Float3{0, 1, 0}));
  EXPECT_TRUE(scene.ignored.empty());
}

TEST(MorphTargets, WeightsOfTheNodeGoBeforeThoseOfTheMesh) {
  Gltf g = with_targets();
  g.json["meshes"][0]["weights"] = {0.5, 0.25};
  g.root({{"mesh", 0}, {"weights", {1, 0}}});
  const SceneFile scene = load(g);
  ASSERT_EQ(scene.instances.size(), 2u);
  expect_near(corner(scene, 0, 1), {1, 0, 1});
  expect_near(corner(scene, 0, 2), {0, 1 + 0.25 * 4, 1.5});
  expect_near(corner(scene, 1, 1), {1, 0, 2});
  expect_near(corner(scene, 1, 2), {0, 1, 3});
  const Mesh& half = scene.meshes[scene.instances[0].mesh];
  EXPECT_NEAR(half.normals[0][0], kSqrtHalf, 1e-6);
  EXPECT_NEAR(half.normals[0][2], kSqrtHalf, 1e-6);
  EXPECT_NE(scene.instances[0].mesh, scene.instances[1].mesh);
}

TEST(MorphTargets, AnimatedWeightsBlendByEachInterpolation) {
  const auto at_half = [](const char* interpolation, const std::vector<float>& values) {
    Gltf g = with_targets();
    g.root({{"mesh", 0}});
    animate_weights(g, 0, {0, 2}, values, interpolation);
    SceneFile scene = load(g);
    const SceneChanges changes = pose(scene, 1);
    EXPECT_EQ(changes.instances, Numbers{0});
    EXPECT_EQ(changes.meshes, Numbers{scene.instances[0].mesh});
    expect_near(corner(scene, 1, 2), {0, 1, 0});
    return corner(scene, 0, 2);
  };
  expect_near(at_half("LINEAR", {0, 0, 1, 0.5}), {0, 1 + 0.25 * 4, 1.5});
  expect_near(at_half("STEP", {1, 0.5, 0, 0}), {0, 1 + 0.5 * 4, 3});
  // Keys of (slopes in, values, slopes out), two numbers each: half-way (a + b) / 2 + (out - in) * 2 / 8.
  expect_near(at_half("CUBICSPLINE", {9, 9, 0, 0, 2, 0, 0, 4, 1, 0.5, 9, 9}), {0, 1 + 4 * (0.25 - 1), 3 * (0.5 + 0.5)});
}

TEST(MorphTargets, OnlyUsedVerticesAreMorphed) {
  Gltf g;
  const int positions = g.floats3({9, 9, 9, 0, 0, 0, 1, 0, 0, 0, 1, 0, 9, 9, 9});
  const int up = g.floats3({0, 0, 7, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 7});
  const int mesh = g.mesh({{"attributes", {{"POSITION", positions}}},
                           {"indices", g.indices({1, 2, 3})},
                           {"targets", {{{"POSITION", up}}}}});
  g.json["meshes"][0]["weights"] = nlohmann::json::array({1});
  g.root({{"mesh", mesh}});
  const SceneFile scene = load(g);
  EXPECT_EQ(scene.meshes[0].positions, (std::vector<Float3>{{0, 0, 1}, {1, 0, 2}, {0, 1, 3}}));
}

TEST(MorphTargets, ShapesAreLimited) {
  Gltf g = with_targets();
  for (int i = 0; i < 50; ++i) g.root({{"mesh", 0}, {"weights", {0.5, i}}});
  const TempFolder folder;
  SceneFile scene;
  LoadLimits limits;
  limits.decoded_bytes = 2000;
  const Status status = load_scene(folder.write("scene.glb", g.glb()), scene, limits);
  EXPECT_EQ(status.code(), StatusCode::resource_limit) << status.message();
  EXPECT_NE(status.message().find("shapes"), std::string::npos) << status.message();
}

}  // namespace
}  // namespace umbrix::io
