// SPDX-License-Identifier: Apache-2.0
// Lights with an area in setup files, and the maps that they name.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "gltf_text.h"
#include "umbrix/io/image_file.h"

namespace umbrix::io {
namespace {

constexpr double kPi = 3.14159265358979323846;

class SetupLights : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(load_scene(folder_.write("tri.gltf", testing::one_triangle().text()), scene_).ok());
  }

  Status load(const std::string& lights, const LoadLimits& limits = {}) {
    return load_setup(folder_.write("setup.json", R"({"lights": [)" + lights + "]}"), scene_, setup_, limits);
  }

  Light light(const std::string& text) {
    const Status status = load(text);
    EXPECT_TRUE(status.ok()) << status.message();
    return setup_.lights.empty() ? Light() : setup_.lights[0];
  }

  void expect_fault(const std::string& text, const std::string& fault, StatusCode code = StatusCode::bad_input,
                    const LoadLimits& limits = {}) {
    SCOPED_TRACE(text);
    const Status status = load(text, limits);
    EXPECT_EQ(status.code(), code);
    EXPECT_NE(status.message().find("setup.json: lights[0]"), std::string::npos) << status.message();
    EXPECT_NE(status.message().find(fault), std::string::npos) << status.message();
    EXPECT_EQ(status.message().find('\n'), std::string::npos) << status.message();
    EXPECT_TRUE(setup_.lights.empty());
  }

  void write_map(const std::string& name, int width, std::vector<float> pixels, std::vector<std::string> channels) {
    Image image;
    image.width = width;
    image.height = static_cast<int>(pixels.size() / channels.size()) / width;
    image.channels = std::move(channels);
    image.pixels = std::move(pixels);
    WriteOptions options;
    options.pixel_type = PixelType::single;
    const Status status = write_image(folder_.path(name), image, options);
    ASSERT_TRUE(status.ok()) << status.message();
  }

  std::string contents(const std::string& name) const {
    std::ifstream in(folder_.path(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  testing::TempFolder folder_;
  SceneFile scene_;
  io::Setup setup_;
};

TEST_F(SetupLights, RectangleHasItsEdgesAcrossItsDirection) {
  const Light l = light(R"({"type": "rectangle", "position": [1, 2, 3], "direction": [0, 0, 2], "width": 4, "height": 1,
    "radiance": 7, "color": [1, 0.5, 0]})");
  EXPECT_EQ(l.type, LightType::rectangle);
  EXPECT_EQ(l.position, (Double3{1, 2, 3}));
  EXPECT_EQ(l.direction, (Double3{0, 0, 1}));
  EXPECT_EQ(l.half_edges[0], (Double3{2, 0, 0}));
  EXPECT_EQ(l.half_edges[1], (Double3{0, 0.5, 0}));
  EXPECT_EQ(l.intensity, 7);
  EXPECT_EQ(l.color, (Float3{1, 0.5f, 0}));
}

TEST_F(SetupLights, RectangleOverheadNeedsNoUp) {
  const Light l =
      light(R"({"type": "rectangle", "position": [0, 3, 0], "direction": [0, -1, 0], "width": 2, "height": 4})");
  EXPECT_EQ(std::abs(l.half_edges[0][0]), 1);
  EXPECT_EQ(std::abs(l.half_edges[1][2]), 2);
  const Light turned = light(R"({"type": "rectangle", "position": [0, 3, 0], "direction": [0, -1, 0], "up": [1, 0, 0],
    "width": 2, "height": 4})");
  EXPECT_EQ(std::abs(turned.half_edges[0][2]), 1);
  EXPECT_EQ(std::abs(turned.half_edges[1][0]), 2);
}

TEST_F(SetupLights, StrengthIsRadiancePowerOrIntensity) {
  const std::string rectangle =
      R"({"type": "rectangle", "position": [0, 3, 0], "direction": [0, -1, 0], "width": 2, "height": 4, )";
  const std::string sphere = R"({"type": "sphere", "position": [0, 3, 0], "radius": 0.5, )";
  EXPECT_NEAR(light(rectangle + R"("power": 100})").intensity, 100 / (8 * kPi), 1e-5);
  EXPECT_NEAR(light(rectangle + R"("intensity": 100})").intensity, 100.0 / 8, 1e-5);
  EXPECT_NEAR(light(sphere + R"("power": 100})").intensity, 100 / (kPi * kPi), 1e-5);
  EXPECT_NEAR(light(sphere + R"("intensity": 100})").intensity, 400 / kPi, 1e-4);
  const Light colored = light(sphere + R"("radiance": [1, 2, 3], "color": [1, 0.5, 2]})");
  EXPECT_EQ(colored.color, (Float3{1, 1, 6}));
  EXPECT_EQ(colored.intensity, 1);
  // As bright as the point light that it stands in for.
  const float candela = light("[0, 3, 0]").intensity;
  EXPECT_NEAR(light(sphere + R"("name": "ball"})").intensity, 4 / kPi * candela, 1e-4 * candela);
  expect_fault(sphere + R"("power": 1, "radiance": 1})", "only one of");
}

TEST_F(SetupLights, FaultsAreNamed) {
  expect_fault(R"({"type": "rectangle", "position": [0, 0, 0], "direction": [0, 0, 1], "width": 1})", "'height'");
  expect_fault(R"({"type": "rectangle", "position": [0, 0, 0], "direction": [0, 0, 1], "width": 0, "height": 1})",
               "width");
  expect_fault(
      R"({"type": "rectangle", "position": [0, 0, 0], "direction": [0, 0, 1], "width": 1, "height": 1, "up": [0, 0, 3]})",
      "'up'");
  expect_fault(R"({"type": "sphere", "position": [0, 0, 0], "radius": -1})", "radius");
  expect_fault(R"({"type": "sphere", "position": [0, 0, 0], "radius": 1e-25, "power": 1})", "too brightly");
  expect_fault(R"({"type": "sphere", "position": [0, 0, 0], "radius": 1, "range": 4})", "'range'");
  expect_fault(R"({"type": "environment", "position": [0, 0, 0]})", "'position'");
  expect_fault(R"({"type": "environment", "radiance": [1, -2, 1]})", "radiance");
  expect_fault(R"({"type": "environment", "file": 3})", "is not a string");
  expect_fault(R"({"type": "mesh"})", "materials");
}

TEST_F(SetupLights, EnvironmentIsWhiteUnlessTold) {
  const Light plain = light(R"({"type": "environment"})");
  EXPECT_EQ(plain.environment, nullptr);
  EXPECT_EQ(plain.color, (Float3{1, 1, 1}));
  EXPECT_EQ(plain.intensity, 1);
  EXPECT_EQ(light(R"({"type": "environment", "radiance": [1, 2, 3]})").color, (Float3{1, 2, 3}));
}

TEST_F(SetupLights, EnvironmentMapIsReadFromItsFile) {
  write_map("sky.exr", 2, {1, 2, 3, 9, 4, 5, -6, 9, 7, 8, 9, 9, 10, 11, 12, 9}, {"R", "G", "B", "A"});
  const Light l = light(R"({"type": "environment", "file": "sky.exr", "radiance": 2, "rotation_degrees": 90})");
  ASSERT_TRUE(l.environment);
  EXPECT_EQ(l.environment->width, 2u);
  EXPECT_EQ(l.environment->height, 2u);
  EXPECT_EQ(l.environment->pixels, (std::vector<Float3>{{1, 2, 3}, {4, 5, 0}, {7, 8, 9}, {10, 11, 12}}))
      << "below zero there is no light";
  EXPECT_NEAR(l.rotation, kPi / 2, 1e-12);
  EXPECT_EQ(l.intensity, 2);

  write_map("grey.exr", 1, {5}, {"Y"});
  EXPECT_EQ(light(R"({"type": "environment", "file": "grey.exr"})").environment->pixels[0], (Float3{5, 5, 5}));
}

TEST_F(SetupLights, MapsThatCannotBeUsedAreRefused) {
  const auto refuse = [&](const std::string& name, const std::string& fault) {
    expect_fault(R"({"type": "environment", "file": ")" + name + "\"}", fault);
  };
  refuse("none.exr", "none.exr: cannot be read");
  refuse("..", "outside the setup file's folder");
  refuse("../sky.exr", "outside the setup file's folder");
  refuse("/etc/hostname", "outside the setup file's folder");
  folder_.write("text.exr", "this is no image");
  refuse("text.exr", "text.exr");
  write_map("nan.exr", 2, {0, 0, 0, 1, std::nanf(""), 1}, {"R", "G", "B"});
  refuse("nan.exr", "pixel (1, 0) is not finite");
  write_map("bands.exr", 1, {0, 0}, {"R", "G"});
  refuse("bands.exr", "no channel B");
  write_map("screen.png", 1, {0, 0, 0}, {"R", "G", "B"});
  refuse("screen.png", "neither OpenEXR nor Radiance");

  // The display window begins 16 bytes after its name and type: make it a pixel wider.
  write_map("crop.exr", 2, {0, 0, 0, 0, 0, 0}, {"R", "G", "B"});
  std::string bytes = contents("crop.exr");
  const std::size_t window = bytes.find("displayWindow");
  ASSERT_NE(window, std::string::npos);
  const std::size_t right = window + std::strlen("displayWindow") + 1 + std::strlen("box2i") + 1 + 4 + 8;
  ASSERT_EQ(bytes[right], 1);
  bytes[right] = 2;
  folder_.write("crop.exr", bytes);
  refuse("crop.exr", "cropped");
}

TEST_F(SetupLights, MapSizeIsLimitedBeforeItIsDecoded) {
  write_map("sky.exr", 4, std::vector<float>(4 * 2 * 3), {"R", "G", "B"});
  LoadLimits limits;
  limits.environment_pixels = 7;
  expect_fault(R"({"type": "environment", "file": "sky.exr"})", "4x2 pixels", StatusCode::resource_limit, limits);
  limits.environment_pixels = 8;
  EXPECT_TRUE(load(R"({"type": "environment", "file": "sky.exr"})", limits).ok());
}

TEST_F(SetupLights, BrokenMapsAreRefusedInOneLine) {
  constexpr unsigned kSeed = 5;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937 random(kSeed);
  write_map("sky.exr", 8, std::vector<float>(8 * 4 * 3, 1.5f), {"R", "G", "B"});
  const std::string good = contents("sky.exr");
  LoadLimits limits;
  limits.environment_pixels = 4096;
  int refused = 0;
  for (int i = 0; i < 150; ++i) {
    std::string bytes = good;
    if (i % 3 == 0) {
      bytes.resize(random() % good.size());
    } else {
      bytes[random() % bytes.size()] = static_cast<char>(random());
    }
    folder_.write("sky.exr", bytes);
    const Status status = load(R"({"type": "environment", "file": "sky.exr"})", limits);
    refused += !status.ok();
    if (status.ok()) continue;
    EXPECT_TRUE(status.code() == StatusCode::bad_input || status.code() == StatusCode::resource_limit);
    EXPECT_EQ(status.message().find('\n'), std::string::npos) << status.message();
  }
  EXPECT_GE(refused, 50) << "at least the short ones";
}

TEST_F(SetupLights, EmissiveInstancesAreLights) {
  testing::Gltf g = testing::one_triangle();
  g.json["materials"] = {{{"emissiveFactor", {0.5, 0, 1}},
                          {"emissiveTexture", {{"index", 0}}},
                          {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 8}}}}}}};
  g.json["textures"] = {{{"source", 0}}};
  g.json["images"] = {{{"uri", "not-there.png"}}};
  g.json["extensionsRequired"] = g.json["extensionsUsed"] = {"KHR_materials_emissive_strength"};
  g.json["meshes"][0]["primitives"][0]["material"] = 0;
  g.root({{"mesh", 0}, {"name", "second"}});
  SceneFile scene;
  const Status status = load_scene(folder_.write("lamps.gltf", g.text()), scene);
  ASSERT_TRUE(status.ok()) << status.message();
  EXPECT_TRUE(scene.lights.empty());
  const std::vector<Light> lights = emissive_lights(scene);
  ASSERT_EQ(lights.size(), 2u);
  EXPECT_EQ(lights[1].type, LightType::mesh);
  EXPECT_EQ(lights[1].name, "second");
  EXPECT_EQ(lights[1].instance, 1u);
  EXPECT_EQ(lights[1].color, (Float3{4, 0, 8}));
  EXPECT_TRUE(emissive_lights(scene_).empty());
}

}  // namespace
}  // namespace umbrix::io
