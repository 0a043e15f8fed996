// SPDX-License-Identifier: Apache-2.0
// Textured scenes from the command line: what is told of pictures, and what becomes of bad ones.
#include <nlohmann/json.hpp>

#include "../io/picture_bytes.h"
#include "program.h"

namespace umbrix::app {
namespace {

class TexturedScene : public ProgramTest {
 protected:
  /// The scene with a texture, "picture.png", as the base colour of all.
  void SetUp() override {
    ProgramTest::SetUp();
    write_scene();
    auto scene = nlohmann::json::parse(read("scene.gltf"));
    scene["images"] = {{{"uri", "picture.png"}}};
    scene["textures"] = {{{"source", 0}}};
    scene["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}, {"metallicFactor", 0}}}}};
    scene["meshes"][0]["primitives"][0]["material"] = 0;
    scene["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = 2;
    scene["accessors"].push_back({{"bufferView", 0}, {"componentType", 5126}, {"count", 8}, {"type", "VEC2"}});
    write("scene.gltf", scene.dump());
    write("picture.png", io::testing::png_bytes(2, 1, 3, {0, 0, 255, 0, 0, 255}));
  }

  Outcome render(const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"render", path("scene.gltf"), "-o", path("out.exr"), "--size",
                                          "16x8",   "--overwrite"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
};

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_F(TexturedScene, PicturesAreUsedAndDescribed) {
  const Outcome rendered = render({"-q"});
  EXPECT_EQ(rendered.code, 0) << rendered.err;
  EXPECT_EQ(rendered.err, "");
  const Outcome outcome = run({"info", path("scene.gltf"), "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto info = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(info["textures"], 1);
  ASSERT_EQ(info["images"].size(), 1u);
  EXPECT_EQ(info["images"][0]["name"], "picture.png");
  EXPECT_EQ(info["images"][0]["format"], "png");
  EXPECT_EQ(info["images"][0]["size"], nlohmann::json({2, 1}));
  EXPECT_EQ(info["images"][0]["used_for"], nlohmann::json({"base color"}));
  EXPECT_TRUE(info["ignored"].empty()) << info["ignored"];
}

TEST_F(TexturedScene, MissingAndDamagedPicturesAreWarnedOf) {
  const std::string whole = read("picture.png");
  ASSERT_EQ(render().code, 0);
  const std::string blue = read("out.exr");
  for (const std::string& bytes : {std::string(), whole.substr(0, 50), std::string("GIF89a")}) {
    std::filesystem::remove(path("picture.png"));
    if (!bytes.empty()) write("picture.png", bytes);
    const Outcome outcome = render();
    EXPECT_EQ(outcome.code, 0);
    EXPECT_TRUE(contains(outcome.err, "picture.png")) << outcome.err;
    EXPECT_FALSE(contains(outcome.err, "libpng")) << outcome.err;
    EXPECT_EQ(render({"-q"}).err, "");
    EXPECT_NE(read("out.exr"), blue);
    const Outcome info = run({"info", path("scene.gltf")});
    EXPECT_EQ(info.code, 0);
    EXPECT_TRUE(contains(info.out, "fault")) << info.out;
  }
}

TEST_F(TexturedScene, PicturesBeyondTheLimitAreSix) {
  write("picture.png", io::testing::png_without_pixels(30000, 30000, 3));
  const Outcome outcome = render();
  EXPECT_EQ(outcome.code, 6);
  EXPECT_TRUE(contains(outcome.err, "picture.png") && contains(outcome.err, "30000 x 30000")) << outcome.err;
  std::filesystem::remove(path("picture.png"));
  std::filesystem::create_symlink("/etc/hostname", path("picture.png"));
  const Outcome outside = render();
  EXPECT_EQ(outside.code, 3);
  EXPECT_TRUE(contains(outside.err, "outside")) << outside.err;
}

}  // namespace
}  // namespace umbrix::app
