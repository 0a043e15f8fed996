// SPDX-License-Identifier: Apache-2.0
// Skins, at rest and animated, against values worked out by hand; and files that must be refused.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "posed_scene.h"

namespace umbrix::io {
namespace {

using namespace testing;

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
  g.animate(0, 2, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0, kSqrtHalf, kSqrtHalf});
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
  g.animate(0, 1, "rotation", {0}, {kSqrtHalf, 0, 0, kSqrtHalf});
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
  g.json["scenes"][0]["nodes"] = nlohmann::json::array({0});
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
  g.json["nodes"][0]["weights"] = nlohmann::json::array({2});
  g.json["nodes"][1]["rotation"] = {0, 0, kSqrtHalf, kSqrtHalf};
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
    {"too_few_joints", [](Gltf& g) { g.json["skins"][0]["joints"] = nlohmann::json::array({1}); }, "asks for joint 1"},
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
    {"joint_is_its_own_ancestor", [](Gltf& g) { g.json["nodes"][2]["children"] = nlohmann::json::array({1}); },
     "its own ancestor"},
    {"weights_of_nothing", [](Gltf& g) { g.json["nodes"][0]["weights"] = nlohmann::json::array({1}); },
     "1 morph weights"},
    {"mesh_weights_of_nothing", [](Gltf& g) { g.json["meshes"][0]["weights"] = nlohmann::json::array({1}); },
     "has 0 targets"},
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

}  // namespace
}  // namespace umbrix::io
