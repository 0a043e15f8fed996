// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "gltf_text.h"

namespace umbrix::io {
namespace {

using testing::TempFolder;

constexpr double kDegree = 3.14159265358979323846 / 180;

Status load(const std::string& text, std::optional<Camera>& camera) {
  const TempFolder folder;
  SceneFile scene;
  EXPECT_TRUE(load_scene(folder.write("tri.gltf", testing::one_triangle().text()), scene).ok());
  Setup setup;
  const Status status = load_setup(folder.write("setup.json", R"({"camera": )" + text + "}"), scene, setup);
  camera = setup.camera;
  return status;
}

Camera camera_of(const std::string& text) {
  std::optional<Camera> camera;
  const Status status = load(text, camera);
  EXPECT_TRUE(status.ok()) << status.message();
  return camera.value_or(Camera());
}

Camera at(const Camera& camera, double frame) {
  Camera moved;
  Moment moment;
  moment.frame = frame;
  const Status status = camera_at(camera, moment, moved);
  EXPECT_TRUE(status.ok()) << status.message();
  return moved;
}

double eye_x(const Camera& camera) { return camera.to_world[0][3]; }

TEST(SetupKeyframes, LinearBetweenKeysAndHeldBeyondThem) {
  const Camera camera = camera_of(R"({"keyframes": [
    {"frame": 1, "eye": [0, 0, 5], "target": [0, 0, 0], "fov_y_degrees": 60},
    {"frame": 11, "eye": [10, 0, 5], "target": [10, 0, 0]},
    {"frame": 13.5, "eye": [0, 0, 5], "target": [0, 0, 0], "fov_y_degrees": 30}]})");
  EXPECT_EQ(eye_x(camera), 0) << "without frames it is as at its first key";
  EXPECT_EQ(motion_span(camera), (std::array<double, 2>{1, 13.5}));
  EXPECT_EQ(eye_x(at(camera, -100)), 0);
  EXPECT_EQ(eye_x(at(camera, 1)), 0);
  EXPECT_NEAR(eye_x(at(camera, 4)), 3, 1e-12);
  EXPECT_EQ(eye_x(at(camera, 11)), 10);
  EXPECT_NEAR(eye_x(at(camera, 12)), 6, 1e-12);
  EXPECT_EQ(eye_x(at(camera, 1000)), 0);
  EXPECT_NEAR(at(camera, 6).yfov, 60 * kDegree, 1e-12) << "a key that says nothing keeps what was before";
  EXPECT_NEAR(at(camera, 12.25).yfov, 45 * kDegree, 1e-12);
  EXPECT_EQ(at(camera, 6).to_world[2], (std::array<double, 4>{0, 0, 1, 5}));
}

TEST(SetupKeyframes, SmoothIsCatmullRomThroughTheKeys) {
  // Keys at 0, 2 and 3: slopes 2, 4/3 and 0.
  const Camera camera = camera_of(R"({"interpolation": "smooth", "keyframes": [
    {"frame": 0, "eye": [0, 0, 5], "target": [0, 0, 0]},
    {"frame": 2, "eye": [4, 0, 5]},
    {"frame": 3, "eye": [4, 0, 5]}]})");
  EXPECT_EQ(eye_x(at(camera, 0)), 0);
  EXPECT_EQ(eye_x(at(camera, 2)), 4);
  // Half way: (a + b) / 2 + (slope_a - slope_b) * span / 8.
  EXPECT_NEAR(eye_x(at(camera, 1)), 2 + (2 - 4.0 / 3) * 2 / 8, 1e-12);
  EXPECT_NEAR(eye_x(at(camera, 2.5)), 4 + 4.0 / 3 / 8, 1e-12);
  // The speed does not jump at a key.
  constexpr double kStep = 1e-6;
  const double before = (4 - eye_x(at(camera, 2 - kStep))) / kStep, after = (eye_x(at(camera, 2 + kStep)) - 4) / kStep;
  EXPECT_NEAR(before, 4.0 / 3, 1e-5);
  EXPECT_NEAR(after, 4.0 / 3, 1e-5);
}

TEST(SetupKeyframes, OneKeyHoldsForAllFrames) {
  for (const char* interpolation : {"linear", "smooth"}) {
    const Camera camera = camera_of(std::string(R"({"interpolation": ")") + interpolation +
                                    R"(", "keyframes": [{"frame": 5, "eye": [1, 0, 5], "target": [1, 0, 0]}]})");
    for (const double frame : {0.0, 5.0, 9.0}) EXPECT_EQ(at(camera, frame).to_world, camera.to_world);
  }
}

TEST(SetupKeyframes, AFrameWithoutADirectionIsRefused) {
  // The eye flies through its target.
  const Camera camera = camera_of(R"({"keyframes": [
    {"frame": 0, "eye": [0, 0, 5], "target": [0, 0, 0]}, {"frame": 10, "eye": [0, 0, -5]}]})");
  Camera moved;
  Moment middle;
  middle.frame = 5;
  const Status status = camera_at(camera, middle, moved);
  EXPECT_EQ(status.code(), StatusCode::bad_input);
  EXPECT_EQ(status.message(), "camera between keyframes: eye and target are the same point");
}

TEST(SetupKeyframes, FaultsAreNamed) {
  const std::string first = R"({"frame": 1, "eye": [0, 0, 5], "target": [0, 0, 0]})";
  const std::pair<std::string, const char*> cases[] = {
      {R"({"keyframes": []})", "at least one key"},
      {R"({"keyframes": 3})", "at least one key"},
      {R"({"keyframes": [3]})", "keyframes[0]: is not an object"},
      {R"({"keyframes": [{"eye": [0, 0, 5], "target": [0, 0, 0]}]})", "keyframes[0]: 'frame' is missing"},
      {R"({"keyframes": [{"frame": 1, "eye": [0, 0, 5]}]})", "keyframes[0]: 'target' is missing"},
      {R"({"keyframes": [{"frame": "1", "eye": [0, 0, 5], "target": [0, 0, 0]}]})", "keyframes[0].frame"},
      {R"({"keyframes": [)" + first + "," + first + "]}", "keyframes[1].frame: 1 is not above"},
      {R"({"keyframes": [)" + first + R"(, {"frame": 2, "eyes": [0, 0, 5]}]})", "unknown member 'eyes'"},
      {R"({"keyframes": [)" + first + R"(, {"frame": 2, "eye": [0, 0, 0]}]})", "keyframes[1]: eye and target"},
      {R"({"keyframes": [)" + first + R"(, {"frame": 2, "up": [0, 0, 1]}]})", "keyframes[1]: 'up'"},
      {R"({"keyframes": [)" + first + R"(, {"frame": 2, "fov_y_degrees": 200}]})", "keyframes[1].fov_y_degrees"},
      {R"({"keyframes": [)" + first + R"(], "interpolation": "bezier"})", "camera.interpolation"},
      {R"({"keyframes": [)" + first + R"(], "eye": [0, 0, 1]})", "unknown member 'eye'"},
      {R"({"eye": [0, 0, 5], "target": [0, 0, 0], "interpolation": "linear"})", "unknown member 'interpolation'"},
  };
  for (const auto& [text, fault] : cases) {
    SCOPED_TRACE(text);
    std::optional<Camera> camera;
    const Status status = load(text, camera);
    EXPECT_EQ(status.code(), StatusCode::bad_input);
    EXPECT_NE(status.message().find(fault), std::string::npos) << status.message();
    EXPECT_FALSE(camera.has_value());
  }
}

}  // namespace
}  // namespace umbrix::io
