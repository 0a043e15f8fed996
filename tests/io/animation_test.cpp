// SPDX-License-Identifier: Apache-2.0
// Cameras that glTF animations move, against values worked out by hand; and files that must be refused.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "gltf_text.h"

namespace umbrix::io {
namespace {

using testing::bytes_of;
using testing::Gltf;
using testing::TempFolder;

const double kHalf = std::sqrt(0.5);
const float kHalfFloat = static_cast<float>(kHalf);

/// A triangle, and as node 1 a camera that looks down from (0, 0, 5).
Gltf with_camera() {
  Gltf g = testing::one_triangle();
  g.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
  g.root({{"camera", 0}, {"name", "eye"}, {"translation", {0, 0, 5}}});
  return g;
}

SceneFile load(const Gltf& g) {
  const TempFolder folder;
  SceneFile scene;
  const Status status = load_scene(folder.write("scene.gltf", g.text()), scene);
  EXPECT_TRUE(status.ok()) << status.message();
  if (scene.cameras.empty()) scene.cameras.resize(1);
  return scene;
}

Camera at(const Camera& camera, double seconds) {
  Camera moved;
  Moment moment;
  moment.seconds = seconds;
  const Status status = camera_at(camera, moment, moved);
  EXPECT_TRUE(status.ok()) << status.message();
  return moved;
}

Double3 place(const Camera& camera) { return {camera.to_world[0][3], camera.to_world[1][3], camera.to_world[2][3]}; }

void expect_near(const Double3& is, const Double3& wanted) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(is[i], wanted[i], 1e-6) << "axis " << i;
}

/// The way the camera looks.
Double3 forward(const Camera& camera) {
  return {-camera.to_world[0][2], -camera.to_world[1][2], -camera.to_world[2][2]};
}

bool mentions(const std::vector<std::string>& lines, const std::string& text) {
  return std::any_of(lines.begin(), lines.end(), [&](const auto& l) { return l.find(text) != std::string::npos; });
}

TEST(Animation, LinearTranslationGoesStraightAndHoldsAtItsEnds) {
  Gltf g = with_camera();
  g.animate(0, 1, "translation", {1, 2, 4}, {0, 0, 0, 2, 4, 6, 2, 0, 6});
  const Camera eye = load(g).cameras[0];
  EXPECT_EQ(place(eye), (Double3{0, 0, 5})) << "at rest the node's own place holds";
  EXPECT_EQ(place(at(eye, -3)), (Double3{0, 0, 0}));
  EXPECT_EQ(place(at(eye, 0.5)), (Double3{0, 0, 0}));
  EXPECT_EQ(place(at(eye, 1.25)), (Double3{0.5, 1, 1.5}));
  EXPECT_EQ(place(at(eye, 2)), (Double3{2, 4, 6}));
  EXPECT_EQ(place(at(eye, 3.5)), (Double3{2, 1, 6}));
  EXPECT_EQ(place(at(eye, 99)), (Double3{2, 0, 6}));
}

TEST(Animation, StepJumpsAtTheFrameOfItsKey) {
  // Keys at frames of 24 and 30 a second: as floats they lie beside the frame's time, on either side.
  for (const double fps : {24.0, 30.0}) {
    for (int frame = 1; frame < 200; ++frame) {
      Gltf g = with_camera();
      g.animate(0, 1, "translation", {0, static_cast<float>(frame / fps)}, {1, 0, 0, 2, 0, 0}, "STEP");
      const Camera eye = load(g).cameras[0];
      ASSERT_EQ(place(at(eye, (frame - 1) / fps))[0], 1) << frame;
      ASSERT_EQ(place(at(eye, (frame - 0.01) / fps))[0], 1) << frame;
      ASSERT_EQ(place(at(eye, frame / fps))[0], 2) << frame;
    }
  }
}

TEST(Animation, CubicSplineFollowsItsSlopes) {
  Gltf g = with_camera();
  // From (0, 0, 0) with slope (3, 0, 0) to (2, 0, 4) with slope (0, 0, 1), in two seconds.
  g.animate(0, 1, "translation", {1, 3}, {9, 9, 9, 0, 0, 0, 3, 0, 0, 0, 0, 1, 2, 0, 4, 9, 9, 9}, "CUBICSPLINE");
  const Camera eye = load(g).cameras[0];
  EXPECT_EQ(place(at(eye, 0)), (Double3{0, 0, 0}));
  EXPECT_EQ(place(at(eye, 3)), (Double3{2, 0, 4}));
  // Half way: (a + b) / 2 + (a_slope - b_slope) * 2 s / 8.
  expect_near(place(at(eye, 2)), {1 + 0.75, 0, 2 - 0.25});
  // A quarter of the way: weights 27/32, 9/64, 5/32 and -3/64.
  expect_near(place(at(eye, 1.5)), {9.0 / 64 * 2 * 3 + 5.0 / 32 * 2, 0, 5.0 / 32 * 4 - 3.0 / 64 * 2});
}

TEST(Animation, LinearRotationTakesTheShorterArcAtEvenSpeed) {
  for (const float sign : {1.0f, -1.0f}) {
    Gltf g = with_camera();
    // A quarter turn about y, given as either of the two quaternions for it.
    g.animate(0, 1, "rotation", {0, 3}, {0, 0, 0, 1, 0, sign * kHalfFloat, 0, sign * kHalfFloat});
    const Camera eye = load(g).cameras[0];
    EXPECT_EQ(place(at(eye, 1)), (Double3{0, 0, 5})) << "what is not animated stays as it is";
    for (const double t : {0.0, 1.0, 2.0, 3.0}) {
      const double angle = std::acos(0.0) * t / 3;
      expect_near(forward(at(eye, t)), {-std::sin(angle), 0, -std::cos(angle)});
    }
  }
}

TEST(Animation, CubicRotationIsMadeUnitLength) {
  Gltf g = with_camera();
  // Slopes of 0: half way lies the sum of both, a turn by an eighth.
  g.animate(0, 1, "rotation", {0, 1},
            {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, kHalfFloat, 0, kHalfFloat, 0, 0, 0, 0}, "CUBICSPLINE");
  expect_near(forward(at(load(g).cameras[0], 0.5)), {-kHalf, 0, -kHalf});
}

TEST(Animation, RotationsMayBeStoredAsSmallIntegers) {
  Gltf g = with_camera();
  g.animate(0, 1, "rotation", {0}, {0, 0, 0, 1});
  const std::vector<std::int16_t> quarter = {0, 23170, 0, 23170};
  const int output = g.accessor(bytes_of(quarter), 5122, 1, "VEC4");
  g.json["accessors"][static_cast<std::size_t>(output)]["normalized"] = true;
  g.json["animations"][0]["samplers"][0]["output"] = output;
  expect_near(forward(at(load(g).cameras[0], 0)), {-1, 0, 0});
}

TEST(Animation, NodesAboveTheCameraMoveIt) {
  Gltf g = with_camera();
  // A boom of length 5 that turns about y, twice as large, on a dolly that rolls along x.
  g.json["nodes"].push_back({{"children", {1}}, {"rotation", {0, 0, 0, 1}}});
  g.json["nodes"].push_back({{"children", {2}}});
  g.json["scenes"][0]["nodes"] = {0, 3};
  g.animate(0, 2, "rotation", {0, 1}, {0, 0, 0, 1, 0, kHalfFloat, 0, kHalfFloat});
  g.animate(0, 2, "scale", {0, 1}, {1, 1, 1, 2, 2, 2});
  g.animate(0, 3, "translation", {0, 1}, {0, 0, 0, 10, 0, 0});
  const Camera eye = load(g).cameras[0];
  expect_near(place(at(eye, 0)), {0, 0, 5});
  expect_near(place(at(eye, 0.5)), {5 + 7.5 * kHalf, 0, 7.5 * kHalf});
  expect_near(place(at(eye, 1)), {20, 0, 0});
  expect_near(forward(at(eye, 1)), {-1, 0, 0});
}

TEST(Animation, SpanIsFromTheFirstToTheLastKeyOfAllThatMoves) {
  Gltf g = with_camera();
  g.animate(0, 1, "translation", {1, 2}, {0, 0, 0, 1, 1, 1});
  g.animate(0, 1, "scale", {0.5f, 1.5f}, {1, 1, 1, 2, 2, 2});
  EXPECT_EQ(motion_span(load(g).cameras[0]), (std::array<double, 2>{0.5, 2}));
  EXPECT_EQ(motion_span(load(with_camera()).cameras[0]), (std::array<double, 2>{0, 0}));
}

TEST(Animation, ANodeMovedToItsPlaceAtRestChangesNoBit) {
  Gltf g = with_camera();
  g.json["nodes"][1]["translation"] = {0.125, 3, 7};
  g.json["nodes"][1]["rotation"] = {0.5, 0.5, -0.5, 0.5};
  g.json["nodes"].push_back({{"children", {1}}, {"translation", {1e-3, 0.7, 12}}, {"rotation", {0.1, 0.2, 0.3, 0.9}}});
  g.json["scenes"][0]["nodes"] = {0, 2};
  g.animate(0, 1, "translation", {0, 1}, {0.125f, 3, 7, 0.125f, 3, 7});
  const Camera eye = load(g).cameras[0];
  EXPECT_EQ(at(eye, 0.3).to_world, eye.to_world);
}

TEST(Animation, AnimationsOfDifferentNodesPlayTogetherAndRivalsDoNot) {
  Gltf g = with_camera();
  g.root({{"camera", 0}});  // node 2
  g.animate(0, 0, "translation", {0}, {1, 1, 1});
  g.animate(1, 1, "translation", {0}, {2, 2, 2});
  g.animate(2, 1, "translation", {0}, {4, 4, 4});
  g.animate(2, 2, "translation", {0}, {3, 3, 3});
  g.animate(3, 2, "translation", {0}, {5, 5, 5});
  const SceneFile scene = load(g);
  EXPECT_EQ(place(at(scene.cameras[0], 0)), (Double3{2, 2, 2}));
  EXPECT_EQ(place(at(scene.cameras.at(1), 0)), (Double3{5, 5, 5})) << "no part of an animation is played";
  EXPECT_TRUE(mentions(scene.ignored, "animations that are not played")) << "animations[2]";
  EXPECT_TRUE(mentions(scene.ignored, "in animations[2]"));
  EXPECT_EQ(scene.instances[0].to_world, kIdentity);
}

TEST(Animation, OneMayBeChosenByNameOrNumber) {
  Gltf g = with_camera();
  for (int i = 0; i < 3; ++i) {
    const auto x = static_cast<float>(i + 1);
    g.animate(static_cast<std::size_t>(i), 1, "translation", {0}, {x, x, x});
    g.json["animations"][static_cast<std::size_t>(i)]["name"] = i == 2 ? "1" : "walk" + std::to_string(i);
  }
  const TempFolder folder;
  const std::string file = folder.write("scene.gltf", g.text());
  const auto x_of = [&](const std::string& animation) {
    SceneFile scene;
    const Status status = load_scene(file, scene, {}, animation);
    EXPECT_TRUE(status.ok()) << status.message();
    return place(at(scene.cameras.at(0), 0))[0];
  };
  EXPECT_EQ(x_of(""), 1);
  EXPECT_EQ(x_of("walk1"), 2);
  EXPECT_EQ(x_of("0"), 1);
  EXPECT_EQ(x_of("1"), 3) << "a name goes before a number";
  SceneFile scene;
  for (const char* wrong : {"run", "3", "-1", "0x", "01 "}) {
    const Status status = load_scene(file, scene, {}, wrong);
    EXPECT_EQ(status.code(), StatusCode::invalid_argument) << wrong;
    EXPECT_NE(status.message().find("the file has 'walk0', 'walk1', '1'"), std::string::npos) << status.message();
  }
  EXPECT_EQ(load(g).animations, (std::vector<std::string>{"walk0", "walk1", "1"}));
}

TEST(Animation, WhatIsNotPlayedIsReported) {
  Gltf g = with_camera();
  g.root({{"name", "empty"}});  // node 2
  g.animate(0, 2, "translation", {0}, {1, 1, 1});
  g.animate(0, 1, "translation", {0}, {1, 1, 1});
  g.json["animations"][0]["channels"].push_back({{"sampler", 0}, {"target", {{"node", 1}, {"path", "pointer"}}}});
  g.animate(1, 1, "translation", {0}, {2, 2, 2});
  g.json["animations"][0]["name"] = "all";
  EXPECT_EQ(load(g).ignored,
            (std::vector<std::string>{
                "animated properties of other kinds: in animations[0] 'all'",
                "animations of nodes that show nothing: in animations[0] 'all'",
                "animations that are not played (an earlier one moves the same nodes, or another was chosen): in "
                "animations[1]"}));
}

TEST(Animation, AStillCameraIsTheSameAtAllTimes) {
  const Camera eye = load(with_camera()).cameras[0];
  EXPECT_EQ(eye.motion, nullptr);
  EXPECT_EQ(at(eye, 12).to_world, eye.to_world);
}

TEST(Animation, AMomentWithoutADirectionIsRefusedAndLeavesTheCameraAlone) {
  Gltf g = with_camera();
  g.animate(0, 1, "scale", {0, 1}, {1, 1, 1, 0, 0, 0});
  const Camera eye = load(g).cameras[0];
  EXPECT_EQ(place(at(eye, 0.5)), (Double3{0, 0, 5}));
  Camera moved = eye;
  moved.name = "untouched";
  Moment end;
  end.seconds = 1;
  const Status status = camera_at(eye, end, moved);
  EXPECT_EQ(status.code(), StatusCode::bad_input);
  EXPECT_EQ(status.message(), "nodes[1] 'eye': the transform leaves the camera no direction");
  EXPECT_EQ(moved.name, "untouched");
}

struct Fault {
  const char* name;
  std::function<void(Gltf&)> make;
  const char* message;
};

nlohmann::json& sampler(Gltf& g) { return g.json["animations"][0]["samplers"][0]; }
nlohmann::json& channel(Gltf& g) { return g.json["animations"][0]["channels"][0]; }
nlohmann::json& keys(Gltf& g, const char* which) { return g.json["accessors"][sampler(g)[which].get<std::size_t>()]; }

/// Replaces the translation of the file by one with other keys.
void keys_are(Gltf& g, const std::vector<float>& times, const std::vector<float>& values) {
  g.json["animations"].clear();
  g.animate(0, 1, "translation", times, values);
}

// Each breaks a file that loads.
const Fault kFaults[] = {
    {"times_not_ascending",
     [](Gltf& g) {
       keys_are(g, {1, 1}, {0, 0, 0, 0, 0, 0});
     },
     "must be above"},
    {"times_descending",
     [](Gltf& g) {
       keys_are(g, {1, 0.5f}, {0, 0, 0, 0, 0, 0});
     },
     "key 1 is 0.5"},
    {"time_nan",
     [](Gltf& g) {
       keys_are(g, {NAN}, {0, 0, 0});
     },
     "not finite"},
    {"value_infinite",
     [](Gltf& g) {
       keys_are(g, {0}, {0, INFINITY, 0});
     },
     "not finite"},
    {"values_too_few",
     [](Gltf& g) {
       keys_are(g, {0, 1}, {0, 0, 0});
     },
     "2 keys need 2"},
    {"spline_without_slopes", [](Gltf& g) { sampler(g)["interpolation"] = "CUBICSPLINE"; }, "need 6"},
    {"interpolation_unknown", [](Gltf& g) { sampler(g)["interpolation"] = "BEZIER"; }, "'BEZIER'"},
    {"interpolation_no_text", [](Gltf& g) { sampler(g)["interpolation"] = 1; }, "samplers[0].interpolation"},
    {"no_keys", [](Gltf& g) { keys(g, "input")["count"] = keys(g, "output")["count"] = 0; }, "no keys"},
    {"times_beyond_buffer", [](Gltf& g) { keys(g, "input")["count"] = 1000; }, "lie beyond"},
    {"times_of_vectors", [](Gltf& g) { sampler(g)["input"] = sampler(g)["output"]; }, "SCALAR"},
    {"times_integers", [](Gltf& g) { keys(g, "input")["componentType"] = 5125; }, "componentType 5125"},
    {"values_of_scalars", [](Gltf& g) { sampler(g)["output"] = sampler(g)["input"]; }, "VEC3"},
    {"values_integers", [](Gltf& g) { keys(g, "output")["componentType"] = 5122; }, "componentType 5122"},
    {"rotation_of_vectors", [](Gltf& g) { channel(g)["target"]["path"] = "rotation"; }, "VEC4"},
    {"rotation_zero",
     [](Gltf& g) {
       g.json["animations"].clear();
       g.animate(0, 1, "rotation", {0}, {0, 0, 0, 0});
     },
     "not a rotation"},
    {"sampler_missing", [](Gltf& g) { channel(g)["sampler"] = 7; }, "sampler 7"},
    {"sampler_negative", [](Gltf& g) { channel(g)["sampler"] = -1; }, "channels[0].sampler"},
    {"target_missing", [](Gltf& g) { channel(g).erase("target"); }, "'target'"},
    {"path_missing", [](Gltf& g) { channel(g)["target"].erase("path"); }, "'path'"},
    {"node_unknown", [](Gltf& g) { channel(g)["target"]["node"] = 9; }, "target.node"},
    {"input_unknown", [](Gltf& g) { sampler(g)["input"] = 99; }, "samplers[0].input"},
    {"twice",
     [](Gltf& g) {
       g.animate(0, 1, "translation", {0}, {0, 0, 0});
     },
     "animated twice"},
    {"node_has_matrix",
     [](Gltf& g) {
       g.json["nodes"][1].erase("translation");
       g.json["nodes"][1]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1};
     },
     "has a matrix"},
};

class BadAnimation : public ::testing::TestWithParam<Fault> {};

TEST_P(BadAnimation, IsRefusedInOneLine) {
  Gltf g = with_camera();
  g.animate(0, 1, "translation", {0, 1}, {0, 0, 0, 1, 1, 1});
  load(g);
  GetParam().make(g);
  const TempFolder folder;
  SceneFile scene;
  const Status status = load_scene(folder.write("scene.gltf", g.text()), scene);
  EXPECT_EQ(status.code(), StatusCode::bad_input) << status.message();
  EXPECT_NE(status.message().find(GetParam().message), std::string::npos) << status.message();
  EXPECT_EQ(status.message().find('\n'), std::string::npos) << status.message();
  EXPECT_TRUE(scene.cameras.empty());
}

INSTANTIATE_TEST_SUITE_P(Faults, BadAnimation, ::testing::ValuesIn(kFaults),
                         [](const auto& fault) { return std::string(fault.param.name); });

TEST(Animation, ChannelsWithoutANodeAndFaultsOfNodesThatShowNothingDoNotMatter) {
  Gltf g = with_camera();
  g.root({{"name", "empty"}});  // node 2
  g.animate(0, 1, "translation", {0}, {1, 2, 3});
  g.json["animations"][0]["channels"].push_back({{"sampler", 0}, {"target", {{"path", "translation"}}}});
  g.animate(0, 2, "translation", {1, 0}, {1, 2, 3, 4, 5, 6});
  EXPECT_EQ(place(at(load(g).cameras[0], 0)), (Double3{1, 2, 3}));
}

TEST(Animation, KeysAreLimited) {
  Gltf g = with_camera();
  const std::vector<float> times = [] {
    std::vector<float> out;
    for (int i = 0; i < 50000; ++i) out.push_back(static_cast<float>(i));
    return out;
  }();
  g.animate(0, 1, "translation", times, std::vector<float>(150000, 0));
  // Six hundred cameras, each with an animation of its own over the same keys.
  for (int i = 0; i < 600; ++i) {
    const int node = g.root({{"camera", 0}});
    nlohmann::json animation = g.json["animations"][0];
    animation["channels"][0]["target"]["node"] = node;
    g.json["animations"].push_back(animation);
  }
  const TempFolder folder;
  SceneFile scene;
  const Status status = load_scene(folder.write("scene.gltf", g.text()), scene);
  EXPECT_EQ(status.code(), StatusCode::resource_limit) << status.message();
}

}  // namespace
}  // namespace umbrix::io
