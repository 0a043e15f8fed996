// SPDX-License-Identifier: Apache-2.0
// Nodes of meshes and lights that glTF animations move, against values worked out by hand.

#include <gtest/gtest.h>

#include <cmath>

#include "posed_scene.h"

namespace umbrix::io {
namespace {

using namespace testing;

TEST(SceneMotion, ASceneWithoutAnimationsStays) {
  SceneFile scene = load(testing::one_triangle());
  EXPECT_EQ(scene.motion, nullptr);
  EXPECT_TRUE(pose(scene, 5).instances.empty());
  EXPECT_EQ(motion_span(scene), (std::array<double, 2>{0, 0}));
}

TEST(SceneMotion, NodesOfMeshesMoveByEachInterpolation) {
  for (const char* interpolation : {"STEP", "LINEAR", "CUBICSPLINE"}) {
    SCOPED_TRACE(interpolation);
    Gltf g = testing::one_triangle();
    g.root({{"mesh", 0}});  // stays
    const bool cubic = std::string(interpolation) == "CUBICSPLINE", step = std::string(interpolation) == "STEP";
    // With slopes of 0 a spline is at its middle half-way, as a line is.
    const auto values = [&](const std::vector<float>& a, const std::vector<float>& b) {
      const std::vector<float> zero(a.size(), 0);
      std::vector<float> out;
      for (const std::vector<float>& key : {a, b}) {
        if (cubic) out.insert(out.end(), zero.begin(), zero.end());
        out.insert(out.end(), key.begin(), key.end());
        if (cubic) out.insert(out.end(), zero.begin(), zero.end());
      }
      return out;
    };
    g.animate(0, 0, "translation", {1, 3}, values({0, 0, 0}, {2, 4, 6}), interpolation);
    g.animate(0, 0, "scale", {1, 3}, values({1, 1, 1}, {3, 1, 1}), interpolation);
    // A half turn about z.
    g.animate(0, 0, "rotation", {1, 3}, values({0, 0, 0, 1}, {0, 0, 1, 0}), interpolation);
    SceneFile scene = load(g);
    EXPECT_EQ(motion_span(scene), (std::array<double, 2>{1, 3}));
    EXPECT_EQ(scene.instances[0].to_world, kIdentity);
    EXPECT_TRUE(pose(scene, 0.5).instances.empty()) << "it is where it was at rest";
    EXPECT_EQ(pose(scene, 2).instances, step ? Numbers{} : Numbers{0});
    // Half-way: moved by (1, 2, 3), a quarter turn, twice as long in x.
    expect_near(corner(scene, 0, 1), step ? Double3{1, 0, 0} : Double3{1, 2 + 2, 3});
    EXPECT_EQ(pose(scene, 3).instances, Numbers{0});
    expect_near(corner(scene, 0, 1), {2 - 3, 4, 6});
    EXPECT_TRUE(pose(scene, 9).instances.empty());
    expect_near(corner(scene, 1, 1), {1, 0, 0});
  }
}

TEST(SceneMotion, ParentsCarryTheirChildren) {
  Gltf g = testing::one_triangle();
  g.json["nodes"].push_back({{"children", {0}}, {"translation", {0, 1, 0}}});
  g.json["nodes"].push_back({{"children", {1}}});
  g.json["scenes"][0]["nodes"] = nlohmann::json::array({2});
  g.json["nodes"][0]["scale"] = {2, 2, 2};
  g.animate(0, 2, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0, kSqrtHalf, kSqrtHalf});
  SceneFile scene = load(g);
  expect_near(corner(scene, 0, 1), {2, 1, 0});
  pose(scene, 1);
  expect_near(corner(scene, 0, 1), {-1, 2, 0});
}

TEST(SceneMotion, LightsMoveAndTurn) {
  Gltf g = testing::one_triangle();
  g.json["extensionsUsed"] = {"KHR_lights_punctual"};
  g.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"}, {"spot", nlohmann::json::object()}},
                                                           {{"type", "point"}}};
  g.root({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});  // node 1
  g.root({{"extensions", {{"KHR_lights_punctual", {{"light", 1}}}}}});  // node 2, stays
  g.animate(0, 1, "translation", {0, 2}, {0, 0, 0, 0, 6, 0});
  g.animate(0, 1, "rotation", {0, 2}, {0, 0, 0, 1, 0, kSqrtHalf, 0, kSqrtHalf});
  SceneFile scene = load(g);
  const SceneChanges changes = pose(scene, 1);
  EXPECT_TRUE(changes.lights);
  EXPECT_TRUE(changes.instances.empty());
  expect_near(scene.lights[0].position, {0, 3, 0});
  expect_near(scene.lights[0].direction, {-kSqrtHalf, 0, -kSqrtHalf});
  expect_near(scene.lights[1].position, {0, 0, 0});
  EXPECT_FALSE(pose(scene, 1).lights);
}

TEST(SceneMotion, APoseDoesNotDependOnTheOneBefore) {
  Gltf g = testing::one_triangle();
  g.animate(0, 0, "translation", {0, 1}, {0.1f, 0.2f, 0.3f, 7, 8, 9});
  SceneFile far = load(g), near = far;
  pose(far, 0.9), pose(far, 0.3), pose(near, 0.3);
  EXPECT_EQ(far.instances[0].to_world, near.instances[0].to_world);
}

TEST(SceneMotion, AMomentThatIsRefusedLeavesTheSceneAlone) {
  Gltf g = testing::one_triangle();
  g.json["extensionsUsed"] = {"KHR_lights_punctual"};
  g.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"}, {"spot", nlohmann::json::object()}}};
  g.root({{"name", "lamp"}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  g.animate(0, 1, "scale", {0, 1}, {1, 1, 1, 0, 0, 0});
  g.animate(0, 0, "translation", {0, 1}, {0, 0, 0, 1, 1, 1});
  SceneFile scene = load(g);
  SceneChanges changes;
  Moment end;
  end.seconds = 1;
  const Status status = pose_scene(scene, end, changes);
  EXPECT_EQ(status.code(), StatusCode::bad_input);
  EXPECT_EQ(status.message(), "nodes[1] 'lamp': the transform leaves the light no direction");
  EXPECT_EQ(scene.instances[0].to_world, kIdentity);
}

}  // namespace
}  // namespace umbrix::io
