// SPDX-License-Identifier: Apache-2.0
// Scenes that glTF animations move: nodes of meshes and lights, morph targets, skins; against values worked out by
// hand.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "gltf_text.h"

namespace umbrix::io {
namespace {

using testing::bytes_of;
using testing::Gltf;
using testing::TempFolder;

const float kHalf = std::sqrt(0.5f);

SceneFile load(const Gltf& g) {
  const TempFolder folder;
  SceneFile scene;
  const Status status = load_scene(folder.write("scene.glb", g.glb()), scene);
  EXPECT_TRUE(status.ok()) << status.message();
  return scene;
}

SceneChanges pose(SceneFile& scene, double seconds) {
  SceneChanges changes;
  Moment moment;
  moment.seconds = seconds;
  const Status status = pose_scene(scene, moment, changes);
  EXPECT_TRUE(status.ok()) << status.message();
  return changes;
}

/// A vertex of an instance, in the world.
Double3 corner(const SceneFile& scene, std::size_t instance, std::size_t vertex) {
  const Transform& m = scene.instances.at(instance).to_world;
  const Float3& p = scene.meshes.at(scene.instances[instance].mesh).positions.at(vertex);
  Double3 out;
  for (std::size_t r = 0; r < 3; ++r) out[r] = m[r][0] * p[0] + m[r][1] * p[1] + m[r][2] * p[2] + m[r][3];
  return out;
}

void expect_near(const Double3& is, const Double3& wanted) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(is[i], wanted[i], 1e-6) << "axis " << i;
}

using Numbers = std::vector<std::uint32_t>;

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
  g.json["scenes"][0]["nodes"] = {2};
  g.json["nodes"][0]["scale"] = {2, 2, 2};
  g.animate(0, 2, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0, kHalf, kHalf});
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
  g.animate(0, 1, "rotation", {0, 2}, {0, 0, 0, 1, 0, kHalf, 0, kHalf});
  SceneFile scene = load(g);
  const SceneChanges changes = pose(scene, 1);
  EXPECT_TRUE(changes.lights);
  EXPECT_TRUE(changes.instances.empty());
  expect_near(scene.lights[0].position, {0, 3, 0});
  expect_near(scene.lights[0].direction, {-kHalf, 0, -kHalf});
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

/// Animates the weights of a node's mesh with two targets.
void animate_weights(Gltf& g, int node, const std::vector<float>& times, const std::vector<float>& values,
                     const char* interpolation = "LINEAR") {
  const int input = g.accessor(bytes_of(times), 5126, times.size(), "SCALAR");
  const int output = g.accessor(bytes_of(values), 5126, values.size(), "SCALAR");
  g.json["animations"].push_back(
      {{"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", "weights"}}}}}}});
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
  EXPECT_NEAR(half.normals[0][0], kHalf, 1e-6);
  EXPECT_NEAR(half.normals[0][2], kHalf, 1e-6);
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
  g.json["meshes"][0]["weights"] = {1};
  g.root({{"mesh", mesh}});
  const SceneFile scene = load(g);
  EXPECT_EQ(scene.meshes[0].positions, (std::vector<Float3>{{0, 0, 1}, {1, 0, 2}, {0, 1, 3}}));
}

/// A strip of two squares up the y axis, on two joints: nodes 1 at the origin and 2 at (0, 1, 0), its child. The lower
/// corners follow the first, the upper the second, those between both. Node 0 places it, which must not matter.
Gltf strip() {
  Gltf g;
  const int positions = g.floats3({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0, 1, 2, 0});
  const int normals = g.floats3({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
  const std::vector<std::uint8_t> joints = {0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
  std::vector<float> weights;
  for (int v = 0; v < 6; ++v) {
    const bool between = v == 2 || v == 3;
    for (const float w : {between ? 0.5f : 1.0f, between ? 0.5f : 0.0f, 0.0f, 0.0f}) weights.push_back(w);
  }
  const int mesh = g.mesh({{"attributes",
                            {{"POSITION", positions},
                             {"NORMAL", normals},
                             {"JOINTS_0", g.accessor(bytes_of(joints), 5121, 6, "VEC4")},
                             {"WEIGHTS_0", g.accessor(bytes_of(weights), 5126, 6, "VEC4")}}},
                           {"indices", g.indices({0, 1, 2, 1, 3, 2, 2, 3, 4, 3, 5, 4})}});
  std::vector<float> inverse_bind;
  for (const float y : {0.0f, -1.0f}) {
    for (const float x :
         {1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, y, 0.0f, 1.0f}) {
      inverse_bind.push_back(x);
    }
  }
  const int matrices = g.accessor(bytes_of(inverse_bind), 5126, 2, "MAT4");
  g.json["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", matrices}}};
  g.root({{"mesh", mesh}, {"skin", 0}, {"translation", {50, 50, 50}}});
  g.root({{"children", {2}}});
  g.json["nodes"].push_back({{"translation", {0, 1, 0}}});
  return g;
}

TEST(Skins, AtRestJointsDecideAndTheNodeDoesNot) {
  Gltf g = strip();
  g.json["nodes"][1]["translation"] = {10, 0, 0};
  const SceneFile scene = load(g);
  expect_near(corner(scene, 0, 0), {10, 0, 0});
  expect_near(corner(scene, 0, 3), {11, 1, 0});
  expect_near(corner(scene, 0, 5), {11, 2, 0});
  EXPECT_EQ(scene.motion, nullptr);
  EXPECT_TRUE(scene.ignored.empty());
}

TEST(Skins, AJointThatTurnsBendsTheMesh) {
  Gltf g = strip();
  // The second joint turns to the left by a quarter.
  g.animate(0, 2, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0, kHalf, kHalf});
  SceneFile scene = load(g);
  expect_near(corner(scene, 0, 4), {0, 2, 0});
  const SceneChanges changes = pose(scene, 1);
  EXPECT_EQ(changes.instances, Numbers{0});
  EXPECT_EQ(changes.meshes, Numbers{0});
  expect_near(corner(scene, 0, 0), {0, 0, 0});
  expect_near(corner(scene, 0, 1), {1, 0, 0});
  // About (0, 1): (x, y) goes to (1 - y, 1 + x); corners between are half there.
  expect_near(corner(scene, 0, 4), {-1, 1, 0});
  expect_near(corner(scene, 0, 5), {-1, 2, 0});
  expect_near(corner(scene, 0, 2), {0, 1, 0});
  expect_near(corner(scene, 0, 3), {0.5, 1.5, 0});
  EXPECT_TRUE(pose(scene, 1).instances.empty());
}

TEST(Skins, NormalsTurnWithTheJoints) {
  Gltf g = strip();
  // A quarter turn about x, and squeezed along what is z before.
  g.animate(0, 1, "rotation", {0}, {kHalf, 0, 0, kHalf});
  g.animate(0, 1, "scale", {0}, {1, 1, 0.25f});
  SceneFile scene = load(g);
  pose(scene, 0);
  const Float3& n = scene.meshes[0].normals[5];
  expect_near({n[0], n[1], n[2]}, {0, -1, 0});
}

TEST(Skins, JointsThatMirrorKeepTheFrontInFront) {
  Gltf g = strip();
  g.json["nodes"][1]["scale"] = {-1, 1, 1};
  const SceneFile scene = load(g);
  expect_near(corner(scene, 0, 5), {-1, 2, 0});
  EXPECT_EQ(scene.instances[0].to_world[0][0], -1) << "so that who asks for the front knows of it";
}

TEST(Skins, WeightsNeedNotSumToOneAndMayBeSmallIntegers) {
  Gltf g = strip();
  const std::vector<std::uint8_t> halves = {9, 0, 0, 0, 9, 0, 0, 0, 3, 3, 0, 0, 3, 3, 0, 0, 0, 0, 0, 0, 9, 0, 0, 0};
  const int weights = g.accessor(bytes_of(halves), 5121, 6, "VEC4");
  g.json["accessors"][static_cast<std::size_t>(weights)]["normalized"] = true;
  g.json["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] = weights;
  g.json["nodes"][2]["translation"] = {2, 1, 0};
  const SceneFile scene = load(g);
  expect_near(corner(scene, 0, 1), {1, 0, 0});
  expect_near(corner(scene, 0, 3), {2, 1, 0});
  expect_near(corner(scene, 0, 4), {0, 2, 0});  // bound to nothing: the first joint's
  expect_near(corner(scene, 0, 5), {3, 2, 0});
}

TEST(Skins, MoreThanFourJointsMayCarryAVertex) {
  Gltf g = strip();
  // Four times nothing, then the second joint.
  std::vector<float> none(24, 0), all(24, 0);
  std::vector<std::uint16_t> second(24, 0);
  for (std::size_t v = 0; v < 6; ++v) all[4 * v + 1] = 1, second[4 * v + 1] = 1;
  nlohmann::json& attributes = g.json["meshes"][0]["primitives"][0]["attributes"];
  attributes["WEIGHTS_0"] = g.accessor(bytes_of(none), 5126, 6, "VEC4");
  attributes["WEIGHTS_1"] = g.accessor(bytes_of(all), 5126, 6, "VEC4");
  attributes["JOINTS_1"] = g.accessor(bytes_of(second), 5123, 6, "VEC4");
  g.json["nodes"][2]["translation"] = {0, 4, 0};
  expect_near(corner(load(g), 0, 0), {0, 3, 0});
}

TEST(Skins, TwoNodesBendOneMeshEachItsWay) {
  Gltf g = strip();
  g.root({{"name", "other joint"}});  // node 3
  g.json["skins"].push_back({{"joints", {3, 3}}});
  g.root({{"mesh", 0}, {"skin", 1}});
  g.root({{"mesh", 0}, {"translation", {0, 0, 9}}});
  g.animate(0, 3, "translation", {0, 1}, {5, 0, 0, 6, 0, 0});
  SceneFile scene = load(g);
  ASSERT_EQ(scene.instances.size(), 3u);
  EXPECT_EQ(pose(scene, 1).instances, Numbers{1});
  expect_near(corner(scene, 0, 5), {1, 2, 0});
  expect_near(corner(scene, 1, 5), {7, 2, 0});
  expect_near(corner(scene, 2, 5), {1, 2, 9});
}

TEST(Skins, JointsNeedNotBeInTheScene) {
  Gltf g = strip();
  g.json["scenes"][0]["nodes"] = {0};
  g.animate(0, 1, "translation", {0, 1}, {0, 0, 0, 0, 0, 3});
  SceneFile scene = load(g);
  pose(scene, 1);
  expect_near(corner(scene, 0, 5), {1, 2, 3});
}

TEST(Skins, MorphTargetsComeFirst) {
  Gltf g = strip();
  std::vector<float> right(18, 0);
  for (std::size_t v = 0; v < 6; ++v) right[3 * v] = 1;
  g.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", g.floats3(right)}}};
  g.json["nodes"][0]["weights"] = {2};
  g.json["nodes"][1]["rotation"] = {0, 0, kHalf, kHalf};
  expect_near(corner(load(g), 0, 1), {0, 3, 0});
}

struct Fault {
  const char* name;
  std::function<void(Gltf&)> make;
  const char* message;
};

nlohmann::json& attributes(Gltf& g) { return g.json["meshes"][0]["primitives"][0]["attributes"]; }
nlohmann::json& accessor_of(Gltf& g, const char* attribute) {
  return g.json["accessors"][attributes(g)[attribute].get<std::size_t>()];
}
nlohmann::json& matrices(Gltf& g) {
  return g.json["accessors"][g.json["skins"][0]["inverseBindMatrices"].get<std::size_t>()];
}

void weights_are(Gltf& g, float weight) {
  attributes(g)["WEIGHTS_0"] = g.accessor(bytes_of(std::vector<float>(24, weight)), 5126, 6, "VEC4");
}

void matrices_are(Gltf& g, float last, std::size_t joints = 2) {
  std::vector<float> m;
  for (std::size_t j = 0; j < joints; ++j) {
    for (int i = 0; i < 16; ++i) m.push_back(i == 15 ? last : i % 5 == 0 ? 1.0f : 0.0f);
  }
  g.json["skins"][0]["inverseBindMatrices"] = g.accessor(bytes_of(m), 5126, joints, "MAT4");
}

void add_target(Gltf& g) {
  g.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", attributes(g)["POSITION"]}}};
}

// Each breaks the strip.
const Fault kFaults[] = {
    {"joint_of_no_node",
     [](Gltf& g) {
       g.json["skins"][0]["joints"] = {1, 99};
     },
     "skins[0].joints[1]"},
    {"no_joints", [](Gltf& g) { g.json["skins"][0]["joints"] = nlohmann::json::array(); }, "has no joints"},
    {"skin_unknown", [](Gltf& g) { g.json["nodes"][0]["skin"] = 4; }, "nodes[0].skin"},
    {"too_few_joints", [](Gltf& g) { g.json["skins"][0]["joints"] = {1}; }, "asks for joint 1"},
    {"joints_floats", [](Gltf& g) { accessor_of(g, "JOINTS_0")["componentType"] = 5126; }, "componentType 5126"},
    {"joints_too_few", [](Gltf& g) { accessor_of(g, "JOINTS_0")["count"] = 5; }, "JOINTS_0 has 5"},
    {"weights_too_few", [](Gltf& g) { accessor_of(g, "WEIGHTS_0")["count"] = 5; }, "WEIGHTS_0 has 5"},
    {"weights_missing", [](Gltf& g) { attributes(g).erase("WEIGHTS_0"); }, "but no WEIGHTS_0"},
    {"weights_not_vectors", [](Gltf& g) { attributes(g)["WEIGHTS_0"] = attributes(g)["POSITION"]; }, "VEC4"},
    {"weights_plain_integers", [](Gltf& g) { accessor_of(g, "WEIGHTS_0")["componentType"] = 5121; }, "componentType"},
    {"weights_nan", [](Gltf& g) { weights_are(g, NAN); }, "weight of nan"},
    {"weights_infinite", [](Gltf& g) { weights_are(g, INFINITY); }, "weight of inf"},
    {"weights_negative", [](Gltf& g) { weights_are(g, -1); }, "weight of -1"},
    {"matrices_nan", [](Gltf& g) { matrices_are(g, NAN); }, "inverse bind matrix 0 is not finite"},
    {"matrices_projective", [](Gltf& g) { matrices_are(g, 2); }, "not affine"},
    {"matrices_too_few", [](Gltf& g) { matrices_are(g, 1, 1); }, "1 inverse bind matrices for 2 joints"},
    {"matrices_cut_off", [](Gltf& g) { matrices(g)["count"] = 2000; }, "lie beyond"},
    {"matrices_vectors", [](Gltf& g) { matrices(g)["type"] = "VEC4"; }, "MAT4"},
    {"joint_is_its_own_ancestor", [](Gltf& g) { g.json["nodes"][2]["children"] = {1}; }, "its own ancestor"},
    {"weights_of_nothing", [](Gltf& g) { g.json["nodes"][0]["weights"] = {1}; }, "1 morph weights"},
    {"mesh_weights_of_nothing", [](Gltf& g) { g.json["meshes"][0]["weights"] = {1}; }, "has 0 targets"},
    {"weights_no_numbers", [](Gltf& g) { g.json["nodes"][0]["weights"] = {"1"}; }, "nodes[0].weights"},
    {"target_too_short",
     [](Gltf& g) {
       g.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", g.floats3({0, 0, 0})}}};
     },
     "targets[0]: POSITION has 1"},
    {"target_unknown",
     [](Gltf& g) {
       g.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", 77}}};
     },
     "targets[0].POSITION"},
    {"animated_weights_too_few",
     [](Gltf& g) {
       add_target(g);
       animate_weights(g, 0, {0, 1}, {0, 0, 0});
     },
     "2 keys need 2 output values"},
    {"animated_weights_nan",
     [](Gltf& g) {
       add_target(g);
       animate_weights(g, 0, {0, 1}, {0, NAN});
     },
     "not finite"},
    {"primitives_differ",
     [](Gltf& g) {
       add_target(g);
       nlohmann::json other = g.json["meshes"][0]["primitives"][0];
       other.erase("targets");
       g.json["meshes"][0]["primitives"].push_back(other);
       animate_weights(g, 0, {0, 1}, {0, 1});
     },
     "different numbers of morph targets"},
    {"too_many_targets",
     [](Gltf& g) {
       add_target(g);
       nlohmann::json& targets = g.json["meshes"][0]["primitives"][0]["targets"];
       targets = std::vector<nlohmann::json>(5000, nlohmann::json::object());
     },
     "5000 morph targets"},
};

class BadSkin : public ::testing::TestWithParam<Fault> {};

TEST_P(BadSkin, IsRefusedInOneLine) {
  Gltf g = strip();
  load(g);
  GetParam().make(g);
  const TempFolder folder;
  SceneFile scene;
  const Status status = load_scene(folder.write("scene.glb", g.glb()), scene);
  EXPECT_FALSE(status.ok());
  EXPECT_NE(status.message().find(GetParam().message), std::string::npos) << status.message();
  EXPECT_EQ(status.message().find('\n'), std::string::npos) << status.message();
  EXPECT_TRUE(scene.meshes.empty());
}

INSTANTIATE_TEST_SUITE_P(Faults, BadSkin, ::testing::ValuesIn(kFaults),
                         [](const auto& fault) { return std::string(fault.param.name); });

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

/// The triangle at places of EXT_mesh_gpu_instancing.
Gltf with_instances(const std::vector<float>& translations) {
  Gltf g = testing::one_triangle();
  g.json["extensionsUsed"] = g.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  g.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", g.floats3(translations)}};
  return g;
}

nlohmann::json& instancing(Gltf& g) {
  return g.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
}

TEST(GpuInstancing, EachElementIsAnInstance) {
  Gltf g = with_instances({0, 0, 0, 1, 2, 3});
  g.json["nodes"][0]["scale"] = {2, 2, 2};
  const std::vector<std::int8_t> turns = {0, 0, 0, 127, 0, 0, 90, 90};  // about z by nothing and by a quarter
  const int rotation = g.accessor(bytes_of(turns), 5120, 2, "VEC4");
  g.json["accessors"][static_cast<std::size_t>(rotation)]["normalized"] = true;
  instancing(g)["ROTATION"] = rotation;
  instancing(g)["SCALE"] = g.floats3({1, 1, 1, 3, 1, 1});
  instancing(g)["_ID"] = rotation;
  SceneFile scene = load(g);
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.instances[1].name, "only");
  EXPECT_EQ(scene.instanced_triangles(), 2u);
  expect_near(corner(scene, 0, 1), {2, 0, 0});
  expect_near(corner(scene, 1, 1), {2, 2 * (2 + 3), 6});
  EXPECT_TRUE(scene.ignored.empty());
}

TEST(GpuInstancing, InstancesMoveWithTheirNode) {
  Gltf g = with_instances({0, 0, 0, 1, 0, 0});
  g.animate(0, 0, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0, kHalf, kHalf});
  SceneFile scene = load(g);
  EXPECT_EQ(pose(scene, 1).instances, (Numbers{0, 1}));
  expect_near(corner(scene, 1, 1), {0, 2, 0});
}

TEST(GpuInstancing, FaultsAreRefused) {
  const auto refused = [](const char* message, const std::function<void(Gltf&)>& make, LoadLimits limits = {}) {
    Gltf g = with_instances({0, 0, 0, 1, 0, 0});
    load(g);
    make(g);
    const TempFolder folder;
    SceneFile scene;
    const Status status = load_scene(folder.write("scene.glb", g.glb()), scene, limits);
    EXPECT_FALSE(status.ok()) << message;
    EXPECT_NE(status.message().find(message), std::string::npos) << status.message();
  };
  refused("SCALE of its instances has 1", [](Gltf& g) { instancing(g)["SCALE"] = g.floats3({1, 1, 1}); });
  refused("neither TRANSLATION", [](Gltf& g) { instancing(g) = nlohmann::json::object(); });
  refused("attributes.SCALE", [](Gltf& g) { instancing(g)["SCALE"] = 99; });
  refused("'attributes' is missing", [](Gltf& g) {
    instancing(g).clear(), g.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"].erase("attributes");
  });
  refused("instance 1: the transform", [](Gltf& g) { instancing(g)["TRANSLATION"] = g.floats3({0, 0, 0, 0, NAN, 0}); });
  refused("not a quaternion",
          [](Gltf& g) { instancing(g)["ROTATION"] = g.accessor(bytes_of(std::vector<float>(8, 0)), 5126, 2, "VEC4"); });
  refused("VEC4", [](Gltf& g) { instancing(g)["ROTATION"] = instancing(g)["TRANSLATION"]; });
  LoadLimits few;
  few.triangles = 1;
  refused(
      "more than 1 triangles over all instances", [](Gltf&) {}, few);
  few = {};
  few.nodes = 1;
  refused(
      "more than 16 instances", [](Gltf& g) { instancing(g)["TRANSLATION"] = g.floats3(std::vector<float>(51)); }, few);
  // Not one byte stands behind these.
  refused("over all instances", [](Gltf& g) {
    g.json["accessors"].push_back({{"componentType", 5126}, {"count", 1ull << 40}, {"type", "VEC3"}});
    instancing(g)["TRANSLATION"] = g.json["accessors"].size() - 1;
  });
}

}  // namespace
}  // namespace umbrix::io
