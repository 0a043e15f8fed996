// SPDX-License-Identifier: Apache-2.0
// Sequences of scenes that move: meshes and lights by glTF animations, in pictures and in what --stats tells.
#include <nlohmann/json.hpp>

#include "program.h"
#include "umbrix/io/image_file.h"

namespace umbrix::app {
namespace {

using Json = nlohmann::json;

class MovingScene : public ProgramTest {
 protected:
  /// The scene of write_scene with animations "first", "second" ... : node `nodes[i]` goes from its place at rest at
  /// 0 s by 3 along x until 1 s. Node 0 is a square above a larger one, 1 the camera, 2 the lamp.
  void write_animated_scene(const std::vector<int>& nodes) {
    write_scene();
    Json scene = Json::parse(read("scene.gltf"));
    const float times[] = {0, 1};
    std::string bytes(reinterpret_cast<const char*>(times), sizeof times);
    const auto add = [&](std::size_t offset, int count, const char* type) {
      scene["bufferViews"].push_back({{"buffer", 1}, {"byteOffset", offset}, {"byteLength", bytes.size() - offset}});
      scene["accessors"].push_back(
          {{"bufferView", scene["bufferViews"].size() - 1}, {"componentType", 5126}, {"count", count}, {"type", type}});
      return scene["accessors"].size() - 1;
    };
    const auto input = add(0, 2, "SCALAR");
    const char* const names[] = {"first", "second", "third"};
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const std::vector<float> rest =
          scene["nodes"][static_cast<std::size_t>(nodes[i])].value("translation", std::vector<float>{0, 0, 0});
      const float places[] = {rest[0], rest[1], rest[2], rest[0] + 3, rest[1], rest[2]};
      const std::size_t offset = bytes.size();
      bytes.append(reinterpret_cast<const char*>(places), sizeof places);
      const auto output = add(offset, 2, "VEC3");
      scene["animations"].push_back(
          {{"name", names[i]},
           {"samplers", {{{"input", input}, {"output", output}}}},
           {"channels", {{{"sampler", 0}, {"target", {{"node", nodes[i]}, {"path", "translation"}}}}}}});
    }
    write("keys.bin", bytes);
    scene["buffers"].push_back({{"byteLength", bytes.size()}, {"uri", "keys.bin"}});
    write("moving.gltf", scene.dump());
  }

  Json render(const std::string& output, const std::string& frames, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {
        "render", path("moving.gltf"), "-q",   "-o",      path(output), "--size",
        "48x32",  "--frames",          frames, "--stats", "-",          "--overwrite"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return Json::parse(outcome.out);
  }

  bool equal(const std::string& a, const std::string& b) const { return read(a) == read(b); }

  /// Whatever the files say of their frames.
  bool same_picture(const std::string& a, const std::string& b) const {
    io::Image first, second;
    EXPECT_TRUE(io::read_image(path(a), first).ok()) << a;
    EXPECT_TRUE(io::read_image(path(b), second).ok()) << b;
    return first.pixels == second.pixels;
  }
};

TEST_F(MovingScene, AMeshThatMovesIsBuiltAnewAndOneThatStaysIsNot) {
  write_animated_scene({0});
  const Json stats = render("a.##.png", "0,12,24,36,48");
  // It moves until frame 24; the tree of the first frame is built before it.
  EXPECT_EQ(stats["trees_built"], 3);
  const std::size_t moved[] = {0, 1, 1, 0, 0};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(stats["frames"][i]["moved_instances"], moved[i]) << i;
    EXPECT_EQ(stats["frames"][i]["tree_built"], moved[i] > 0) << i;
    EXPECT_GE(stats["frames"][i]["seconds"]["build"], 0);
  }
  EXPECT_FALSE(same_picture("a.00.png", "a.12.png"));
  EXPECT_FALSE(same_picture("a.12.png", "a.24.png"));
  EXPECT_TRUE(same_picture("a.24.png", "a.36.png"));
  EXPECT_TRUE(same_picture("a.24.png", "a.48.png"));
}

TEST_F(MovingScene, AFrameIsTheSameInEveryRunAndForEveryKernel) {
  write_animated_scene({0, 2});
  render("whole.##.exr", "1-6");
  render("part.##.exr", "6,3", {"-j", "1"});
  render("brute.##.exr", "3", {"--kernel", "brute"});
  EXPECT_TRUE(equal("whole.03.exr", "part.03.exr"));
  EXPECT_TRUE(equal("whole.06.exr", "part.06.exr"));
  EXPECT_TRUE(equal("whole.03.exr", "brute.03.exr"));
  EXPECT_FALSE(same_picture("whole.03.exr", "whole.06.exr"));
}

TEST_F(MovingScene, TheFirstFrameOfAMoveIsTheStill) {
  write_animated_scene({0});
  render("a.##.png", "0,24");
  ASSERT_EQ(run({"render", path("moving.gltf"), "-q", "-o", path("still.png"), "--size", "48x32"}).code, 0);
  EXPECT_TRUE(same_picture("still.png", "a.00.png"));
  EXPECT_FALSE(same_picture("still.png", "a.24.png"));
}

TEST_F(MovingScene, LightsMoveWithoutANewTree) {
  write_animated_scene({2});
  const Json stats = render("a.##.png", "0,12,24");
  EXPECT_EQ(stats["trees_built"], 1);
  EXPECT_EQ(stats["frames"][0]["moved_lights"], false);
  EXPECT_EQ(stats["frames"][1]["moved_lights"], true);
  EXPECT_FALSE(same_picture("a.00.png", "a.12.png"));
}

TEST_F(MovingScene, LightsOfASetupFileStay) {
  write_animated_scene({2});
  write("setup.json", R"({"lights": [{"type": "point", "position": [0, 1, 3], "intensity": 30}]})");
  render("a.##.png", "0,24", {"--setup", path("setup.json")});
  EXPECT_TRUE(same_picture("a.00.png", "a.24.png"));
}

TEST_F(MovingScene, AStillSceneIsBuiltOnce) {
  write_scene();
  write("moving.gltf", read("scene.gltf"));
  const Json stats = render("a.##.png", "0,24");
  EXPECT_EQ(stats["trees_built"], 1);
  EXPECT_TRUE(same_picture("a.00.png", "a.24.png"));
}

TEST_F(MovingScene, OneAnimationMayBeChosen) {
  write_animated_scene({0, 2});
  render("all.##.png", "0,24");
  const Json lamp = render("lamp.##.png", "0,24", {"--animation", "second"});
  const Json square = render("square.##.png", "0,24", {"--animation", "0"});
  EXPECT_EQ(lamp["trees_built"], 1);
  EXPECT_EQ(square["trees_built"], 2);
  EXPECT_EQ(square["frames"][1]["moved_lights"], false);
  EXPECT_TRUE(same_picture("all.00.png", "lamp.00.png"));
  EXPECT_FALSE(same_picture("all.24.png", "lamp.24.png"));
  EXPECT_FALSE(same_picture("all.24.png", "square.24.png"));
  const Outcome wrong =
      run({"render", path("moving.gltf"), "-o", path("x.##.png"), "--frames", "1", "--animation", "no"});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(wrong.err.find("moving.gltf: there is no animation 'no'; the file has 'first', 'second'"),
            std::string::npos)
      << wrong.err;
}

TEST_F(MovingScene, InfoTellsWhatMoves) {
  write_animated_scene({0, 1});
  const Json info = Json::parse(run({"info", path("moving.gltf"), "--json"}).out);
  EXPECT_EQ(info["animations"], Json({"first", "second"}));
  EXPECT_EQ(info["moves_seconds"], Json({0, 1}));
  EXPECT_EQ(info["cameras"][0]["moves_seconds"], Json({0, 1}));
  EXPECT_TRUE(info["ignored"].empty());
  write_animated_scene({1});
  EXPECT_EQ(Json::parse(run({"info", path("moving.gltf"), "--json"}).out)["moves_seconds"], nullptr);
}

TEST_F(MovingScene, AFrameWithoutAPlaceIsNamed) {
  write_animated_scene({0});
  Json scene = Json::parse(read("moving.gltf"));
  scene["animations"][0]["channels"][0]["target"]["path"] = "rotation";
  const auto output = scene["animations"][0]["samplers"][0]["output"].get<std::size_t>();
  scene["accessors"][output]["type"] = "VEC4";
  scene["animations"][0]["samplers"][0]["interpolation"] = "CUBICSPLINE";
  // One key: slopes, then a rotation, slopes: the rotation of length 0 cannot be one.
  const float keys[] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  scene["accessors"][output]["count"] = 3;
  scene["accessors"][scene["animations"][0]["samplers"][0]["input"].get<std::size_t>()]["count"] = 1;
  std::string bytes = read("keys.bin").substr(0, 8);
  bytes.append(reinterpret_cast<const char*>(keys), sizeof keys);
  write("keys.bin", bytes);
  scene["buffers"][1]["byteLength"] = bytes.size();
  scene["bufferViews"].back()["byteLength"] = sizeof keys;
  write("moving.gltf", scene.dump());
  const Outcome outcome = run({"render", path("moving.gltf"), "-o", path("x.##.png"), "--frames", "1"});
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  EXPECT_NE(outcome.err.find("not a rotation"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace umbrix::app
