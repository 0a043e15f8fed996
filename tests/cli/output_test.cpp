// SPDX-License-Identifier: Apache-2.0
// The files that a render leaves: what is in them, and what is never harmed.
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "program.h"
#include "umbrix/io/image_file.h"

namespace umbrix::app {
namespace {

class Output : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write_scene();
  }

  Outcome render(const std::string& output, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"render", path("scene.gltf"), "-q", "-o", path(output), "--size", "64x32"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }

  io::Image image(const std::string& name) {
    io::Image result;
    const Status status = io::read_image(path(name), result);
    EXPECT_TRUE(status.ok()) << status.message();
    return result;
  }
};

float pixel(const io::Image& image, int x, int y, const std::string& channel) {
  const auto found = std::find(image.channels.begin(), image.channels.end(), channel);
  if (found == image.channels.end()) {
    ADD_FAILURE() << "no channel " << channel;
    return -1;
  }
  const auto index = static_cast<std::size_t>(y * image.width + x) * image.channels.size();
  return image.pixels[index + static_cast<std::size_t>(found - image.channels.begin())];
}

TEST_F(Output, ExrAndPngShowTheScene) {
  ASSERT_EQ(render("out.exr", {"-o", path("out.png"), "--aov", "depth,shadow", "--float"}).code, 0);
  const io::Image exr = image("out.exr"), png = image("out.png");
  for (const io::Image* each : {&exr, &png}) {
    EXPECT_EQ(each->width, 64);
    EXPECT_EQ(each->height, 32);
  }
  // The lower square is 4 from the camera, the upper one 3.5; its shadow falls away from the lamp.
  EXPECT_EQ(pixel(exr, 16, 16, "depth.Z"), 4);
  EXPECT_EQ(pixel(exr, 34, 14, "depth.Z"), 3.5f);
  EXPECT_EQ(pixel(exr, 16, 16, "shadow.Y"), 1);
  EXPECT_EQ(pixel(exr, 16, 16, "A"), 1);
  EXPECT_GT(pixel(exr, 16, 16, "R"), 0.2f);
  EXPECT_GT(pixel(png, 16, 16, "R"), 0.2f);
}

TEST_F(Output, PixelTypeIsAsAsked) {
  ASSERT_EQ(render("half.exr").code, 0);
  ASSERT_EQ(render("float.exr", {"--float"}).code, 0);
  EXPECT_NE(image("half.exr").pixels, image("float.exr").pixels);
}

TEST_F(Output, CropIsThatPartOfTheWhole) {
  ASSERT_EQ(render("whole.exr", {"--spp", "3"}).code, 0);
  ASSERT_EQ(render("part.exr", {"--spp", "3", "--crop", "20x10+30+8"}).code, 0);
  const io::Image whole = image("whole.exr"), part = image("part.exr");
  ASSERT_EQ(part.width, 20);
  ASSERT_EQ(part.height, 10);
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 20; ++x) EXPECT_EQ(pixel(part, x, y, "G"), pixel(whole, x + 30, y + 8, "G"));
  }
}

TEST_F(Output, BytesDependOnNeitherThreadsNorKernelNorInstructionSet) {
  ASSERT_EQ(render("first.exr", {"--spp", "4", "-j", "1"}).code, 0);
  ASSERT_EQ(render("again.exr", {"--spp", "4", "-j", "7"}).code, 0);
  ASSERT_EQ(render("brute.exr", {"--spp", "4", "--kernel", "brute"}).code, 0);
  // The portable instruction set, whose name depends on the compiler.
  const std::string portable = nlohmann::json::parse(run({"kernels", "--json"}).out)["simd_targets"].back();
  ASSERT_EQ(render("portable.exr", {"--spp", "4", "--simd", portable, "--build-quality", "fast"}).code, 0);
  for (const char* other : {"again.exr", "brute.exr", "portable.exr"})
    EXPECT_TRUE(read("first.exr") == read(other)) << other;
  ASSERT_EQ(render("seed.exr", {"--spp", "4", "--seed", "9"}).code, 0);
  EXPECT_FALSE(read("first.exr") == read("seed.exr"));
}

TEST_F(Output, FilterSpreadsThePixelsSamples) {
  ASSERT_EQ(render("box.exr", {"--spp", "4"}).code, 0);
  ASSERT_EQ(render("same.exr", {"--spp", "4", "--filter", "box"}).code, 0);
  ASSERT_EQ(render("wide.exr", {"--spp", "4", "--filter", "gaussian"}).code, 0);
  EXPECT_EQ(image("box.exr").pixels, image("same.exr").pixels);
  EXPECT_NE(image("box.exr").pixels, image("wide.exr").pixels);
}

TEST_F(Output, AmbientOcclusionLooksAsFarAsAsked) {
  ASSERT_EQ(render("far.exr", {"--spp", "16", "--aov", "ao"}).code, 0);
  ASSERT_EQ(render("near.exr", {"--spp", "16", "--aov", "ao", "--ao-distance", "0.001"}).code, 0);
  // The upper square is half a unit above the lower one.
  const auto least = [&](const char* name) {
    const io::Image picture = image(name);
    float value = 1;
    for (int x = 16; x < 48; ++x) value = std::min(value, pixel(picture, x, 17, "ao.Y"));
    return value;
  };
  EXPECT_LT(least("far.exr"), 0.95f);
  EXPECT_EQ(least("near.exr"), 1);
}

TEST_F(Output, SizeDefaultsToTheCamerasAspect) {
  ASSERT_EQ(run({"render", path("scene.gltf"), "-q", "-o", path("out.png")}).code, 0);
  EXPECT_EQ(image("out.png").width, 1440);
  EXPECT_EQ(image("out.png").height, 720);
}

TEST_F(Output, ExposureBrightensPngAlone) {
  ASSERT_EQ(render("plain.png", {"-o", path("plain.exr")}).code, 0);
  ASSERT_EQ(render("bright.png", {"-o", path("bright.exr"), "--exposure", "-1"}).code, 0);
  EXPECT_LT(pixel(image("bright.png"), 16, 16, "R"), pixel(image("plain.png"), 16, 16, "R"));
  EXPECT_TRUE(read("plain.exr") == read("bright.exr"));
}

TEST_F(Output, SetupGivesCameraAndLights) {
  write("setup.json",
        R"({"camera": {"eye": [0, 0, 8], "target": [0, 0, 0], "up": [0, 1, 0], "fov_y_degrees": 30},
            "lights": [[0, 0, 3]]})");
  ASSERT_EQ(render("out.exr", {"--setup", path("setup.json"), "--aov", "depth", "--float"}).code, 0);
  EXPECT_EQ(pixel(image("out.exr"), 24, 16, "depth.Z"), 8);
}

TEST_F(Output, EnvironmentLightsAndFillsTheBackground) {
  write("setup.json", R"({"lights": [{"type": "environment", "radiance": [0.5, 0.25, 1]}]})");
  ASSERT_EQ(render("out.exr", {"--setup", path("setup.json"), "--float", "--light-samples", "256"}).code, 0);
  const io::Image sky = image("out.exr");
  EXPECT_EQ(pixel(sky, 0, 0, "B"), 1);
  EXPECT_EQ(pixel(sky, 0, 0, "A"), 1);
  // glTF's default material is a white metal, which reflects all that comes from above.
  EXPECT_NEAR(pixel(sky, 16, 16, "B"), 1, 0.05f);
  EXPECT_NEAR(pixel(sky, 16, 16, "R"), 0.5f * pixel(sky, 16, 16, "B"), 1e-5f);
}

TEST_F(Output, EmissiveMeshesLightTheSceneUnlessToldOtherwise) {
  // A small lamp above the squares that shines down on them, beside the file's own light.
  auto scene = nlohmann::json::parse(read("scene.gltf"));
  scene["materials"] = {{{"emissiveFactor", {1, 1, 1}}}};
  nlohmann::json lamp = scene["meshes"][0];
  lamp["primitives"][0]["material"] = 0;
  scene["meshes"].push_back(lamp);
  scene["nodes"].push_back(
      {{"mesh", 1}, {"translation", {0, 0, 3}}, {"rotation", {1, 0, 0, 0}}, {"scale", {0.1, 0.1, 0.1}}});
  scene["scenes"][0]["nodes"].push_back(scene["nodes"].size() - 1);
  write("scene.gltf", scene.dump());
  ASSERT_EQ(render("lit.exr", {"--float"}).code, 0);
  ASSERT_EQ(render("unlit.exr", {"--float", "--no-mesh-lights"}).code, 0);
  EXPECT_GT(pixel(image("lit.exr"), 16, 16, "R"), pixel(image("unlit.exr"), 16, 16, "R"));
}

TEST_F(Output, ExistingFileIsKeptUnlessToldOtherwise) {
  write("out.exr", "precious");
  const Outcome refused = render("out.exr");
  EXPECT_EQ(refused.code, 4);
  EXPECT_NE(refused.err.find("out.exr"), std::string::npos) << refused.err;
  EXPECT_EQ(read("out.exr"), "precious");
  EXPECT_EQ(render("out.exr", {"--overwrite"}).code, 0);
  EXPECT_EQ(image("out.exr").width, 64);
}

TEST_F(Output, ImpossibleOutputsAreFourBeforeAnyWork) {
  // The scene does not exist: that outputs are refused first shows that nothing was loaded.
  write("file", "");
  for (const char* output : {"nowhere/out.exr", "out.tiff", "out", "file/out.exr"}) {
    const Outcome outcome = run({"render", path("absent.gltf"), "-o", path(output)});
    EXPECT_EQ(outcome.code, 4) << output << outcome.err;
    EXPECT_NE(outcome.err.find(output), std::string::npos) << outcome.err;
  }
}

TEST_F(Output, UnwritableFolderIsFour) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  mkdir(path("locked").c_str(), 0500);
  EXPECT_EQ(render("locked/out.exr").code, 4);
}

TEST_F(Output, MissingFolderIsMadeOnRequest) {
  EXPECT_EQ(render("a/b/out.exr").code, 4);
  EXPECT_EQ(render("a/b/out.exr", {"--create-dir", "--dry-run"}).code, 0);
  EXPECT_FALSE(exists("a"));
  EXPECT_EQ(render("a/b/out.exr", {"--create-dir"}).code, 0);
  EXPECT_TRUE(exists("a/b/out.exr"));
}

TEST_F(Output, InputIsNeverOverwritten) {
  const std::string before = read("scene.bin");
  write("scene.exr", read("scene.gltf"));  // a scene is told by its content
  const Outcome outcome = run({"render", path("scene.exr"), "-o", path("scene.exr"), "--overwrite"});
  EXPECT_EQ(outcome.code, 4);
  EXPECT_EQ(read("scene.exr"), read("scene.gltf"));
}

TEST_F(Output, ChannelsBeyondColourNeedAnExr) { EXPECT_EQ(render("out.png", {"--aov", "normal"}).code, 2); }

TEST_F(Output, InstancesThatShareTheirMeshLookTheSameInLessMemory) {
  const auto forest = [&](const std::string& instances) {
    return run(
        {"render", UMBRIX_FOREST, "-q", "--size", "96x54", "--instances", instances, "-o", path(instances + ".exr")});
  };
  const Outcome placed = forest("flatten"), shared = forest("share"), unknown = forest("copy");
  ASSERT_EQ(placed.code, 0);
  ASSERT_EQ(shared.code, 0);
  EXPECT_EQ(read("flatten.exr"), read("share.exr"));
#ifndef __SANITIZE_ADDRESS__  // which holds as much by itself
  EXPECT_LT(shared.peak_megabytes, 0.7 * placed.peak_megabytes);
#endif
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.err.find("--instances: 'copy' is not one of auto|flatten|share"), std::string::npos);
}

}  // namespace
}  // namespace umbrix::app
