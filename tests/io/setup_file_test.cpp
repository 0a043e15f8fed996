// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "gltf_text.h"

namespace umbrix::io {
namespace {

using testing::TempFolder;

constexpr double kPi = 3.14159265358979323846;

struct Result {
  Status status;
  Setup setup;
};

Result load(const std::string& text) {
  const TempFolder folder;
  SceneFile scene;
  EXPECT_TRUE(load_scene(folder.write("tri.gltf", testing::one_triangle().text()), scene).ok());
  Result result;
  result.status = load_setup(folder.write("setup.json", text), scene, result.setup);
  return result;
}

TEST(SetupFile, CameraLooksFromEyeToTarget) {
  const Result r = load(R"({"camera": {"eye": [0, 0, 5], "target": [0, 0, 0], "up": [0, 1, 0], "fov_y_degrees": 90}})");
  ASSERT_TRUE(r.status.ok()) << r.status.message();
  ASSERT_TRUE(r.setup.camera.has_value());
  EXPECT_NEAR(r.setup.camera->yfov, kPi / 2, 1e-12);
  EXPECT_EQ(r.setup.camera->to_world, (Transform{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 5}}}));
  EXPECT_TRUE(r.setup.lights.empty());
}

TEST(SetupFile, Lights) {
  const Result r = load(R"({"lights": [[1, 2, 3],
    {"type": "spot", "position": [0, 3, 0], "direction": [0, -2, 0], "intensity": 9, "color": [1, 0.5, 0],
     "range": 4, "inner_cone_degrees": 30, "outer_cone_degrees": 60},
    {"type": "directional", "direction": [0, 0, -1]}]})");
  ASSERT_TRUE(r.status.ok()) << r.status.message();
  ASSERT_EQ(r.setup.lights.size(), 3u);
  EXPECT_EQ(r.setup.lights[0].type, LightType::point);
  EXPECT_EQ(r.setup.lights[0].position, (Double3{1, 2, 3}));
  // The triangle's centre is at (1, 1, 0) / 3: half of pi times the squared distance, which is known to the half of a
  // sixteenth of an octave.
  const double expected = 0.5 * kPi * (4.0 / 9 + 25.0 / 9 + 9);
  EXPECT_NEAR(r.setup.lights[0].intensity, expected, (std::exp2(1.0 / 16) - 1) * expected);
  EXPECT_EQ(r.setup.lights[1].direction, (Double3{0, -1, 0}));
  EXPECT_EQ(r.setup.lights[1].intensity, 9);
  EXPECT_EQ(r.setup.lights[1].range, 4);
  EXPECT_NEAR(r.setup.lights[1].outer_cone_angle, kPi / 3, 1e-6);
  EXPECT_NEAR(r.setup.lights[2].intensity, kPi, 1e-6);
}

TEST(SetupFile, ArrayEntryIsChosenByFileOrName) {
  const std::string other = R"({"file": "other.glb", "lights": [[9, 9, 9]]},)";
  for (const char* key : {R"("file": "tri.gltf")", R"("name": "tri")"}) {
    const Result r = load("[" + other + "{" + key + R"(, "triangles": 1, "lights": [[1, 1, 1]]}])");
    ASSERT_TRUE(r.status.ok()) << r.status.message();
    EXPECT_EQ(r.setup.lights.at(0).position[0], 1);
  }
  EXPECT_NE(load("[" + other.substr(0, other.size() - 1) + "]").status.message().find("tri.gltf"), std::string::npos);
}

TEST(SetupFile, FaultsAreNamed) {
  const std::pair<const char*, const char*> cases[] = {
      {"", "empty"},
      {"{", "JSON"},
      {"3", "object"},
      {"{}", "neither"},
      {R"({"lights": [[1, 2]]})", "lights[0]"},
      {R"({"lights": [{"type": "sun"}]})", "sun"},
      {R"({"lights": [{"type": "point", "position": [0, 0, 0], "intensty": 3}]})", "intensty"},
      {R"({"lights": [{"type": "point", "position": [0, 0, 0], "intensity": -3}]})", "intensity"},
      {R"({"lights": [{"type": "directional", "direction": [0, 0, 0]}]})", "direction"},
      {R"({"camera": {"eye": [0, 0, 0], "target": [0, 0, 0]}})", "same point"},
      {R"({"camera": {"eye": [0, 1, 0], "target": [0, 0, 0], "up": [0, 1, 0]}})", "'up'"},
      {R"({"camera": {"eye": [0, 1, 0]}})", "target"},
      {R"({"camera": {"eye": [0, 0, 1], "target": [0, 0, 0], "fov_y_degrees": 180}})", "fov_y_degrees"},
  };
  for (const auto& [text, fault] : cases) {
    SCOPED_TRACE(text);
    const Result r = load(text);
    EXPECT_EQ(r.status.code(), StatusCode::bad_input);
    EXPECT_NE(r.status.message().find("setup.json"), std::string::npos) << r.status.message();
    EXPECT_NE(r.status.message().find(fault), std::string::npos) << r.status.message();
    EXPECT_FALSE(r.setup.camera.has_value());
    EXPECT_TRUE(r.setup.lights.empty());
  }
}

}  // namespace
}  // namespace umbrix::io
