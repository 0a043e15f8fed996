// SPDX-License-Identifier: Apache-2.0
// Sequences: a frame's files are the same however the range is cut, and nothing half-done is left.
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "program.h"
#include "umbrix/io/image_file.h"

namespace umbrix::app {
namespace {

using Json = nlohmann::json;

const char* const kOrbit = R"({"camera": {"interpolation": "smooth", "keyframes": [
  {"frame": 1, "eye": [0, 0, 4], "target": [0, 0, 0], "fov_y_degrees": 46},
  {"frame": 4, "eye": [1, 0, 4]},
  {"frame": 8, "eye": [1, 2, 3], "fov_y_degrees": 60}]}})";

class Sequence : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write_scene();
    write("orbit.json", kOrbit);
  }

  Outcome render(const std::string& frames, const std::string& output, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"render",     path("scene.gltf"), "--setup", path("orbit.json"), "-q", "-o",
                                          path(output), "--size",           "32x16"};
    if (!frames.empty()) arguments.insert(arguments.end(), {"--frames=" + frames});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }

  /// The scene with a camera that glides along x, from 0 at 0 s to 4 at 2 s.
  void write_animated_scene() const {
    Json scene = Json::parse(read("scene.gltf"));
    const float keys[] = {0, 2, 0, 0, 4, 4, 0, 4};  // two times, two places
    write("keys.bin", {reinterpret_cast<const char*>(keys), sizeof keys});
    scene["buffers"].push_back({{"byteLength", 32}, {"uri", "keys.bin"}});
    scene["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 8}});
    scene["bufferViews"].push_back({{"buffer", 1}, {"byteOffset", 8}, {"byteLength", 24}});
    scene["accessors"].push_back({{"bufferView", 2}, {"componentType", 5126}, {"count", 2}, {"type", "SCALAR"}});
    scene["accessors"].push_back({{"bufferView", 3}, {"componentType", 5126}, {"count", 2}, {"type", "VEC3"}});
    scene["animations"] = {{{"samplers", {{{"input", 2}, {"output", 3}}}},
                            {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}}}};
    write("moving.gltf", scene.dump());
  }

  /// Where the camera of an image was, along x.
  double camera_x(const std::string& name) const {
    io::Image image;
    EXPECT_TRUE(io::read_image(path(name), image).ok());
    for (const auto& [matrix, values] : image.matrices) {
      // It looks straight down: the translation is the eye's, negated.
      if (matrix == "worldToCamera") return -static_cast<double>(values[12]);
    }
    ADD_FAILURE() << "no matrix in " << name;
    return 0;
  }
};

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_F(Sequence, FilesDoNotDependOnHowTheRangeIsCut) {
  const std::vector<std::string> more = {"-o", path("whole.%03d.png"), "--spp", "3", "--aov", "depth,shadow"};
  ASSERT_EQ(render("1-8", "whole.####.exr", more).code, 0);
  const std::vector<std::string> chunk = {"-o", path("part.###.png"), "--spp", "3", "--aov", "depth,shadow", "-j", "1"};
  ASSERT_EQ(render("5-8", "part.####.exr", chunk).code, 0);
  ASSERT_EQ(render("3,1-4:2", "part.%04d.exr", chunk).code, 0);
  const std::vector<std::string> alone = {"-o", path("part.002.png"), "--spp", "3", "--aov", "depth,shadow"};
  ASSERT_EQ(render("2", "part.0002.exr", alone).code, 0);
  ASSERT_EQ(render("4", "part.####.exr",
                   {"-o", path("part.###.png"), "--spp", "3", "--aov", "depth,shadow", "--kernel", "brute", "--stats",
                    path("stats.json")})
                .code,
            0);
  for (int frame = 1; frame <= 8; ++frame) {
    const std::string number = "." + std::string(3, '0') + std::to_string(frame) + ".exr";
    EXPECT_TRUE(read("whole" + number) == read("part" + number)) << number;
    const std::string png = "." + std::string(2, '0') + std::to_string(frame) + ".png";
    EXPECT_TRUE(read("whole" + png) == read("part" + png)) << png;
  }
  EXPECT_FALSE(read("whole.0001.exr") == read("whole.0002.exr"));
}

TEST_F(Sequence, AStillIsAsAtTheFirstKey) {
  ASSERT_EQ(render("", "still.png").code, 0);
  ASSERT_EQ(render("-7,1,99", "key.####.png").code, 0);
  io::Image still, first, before, after;
  ASSERT_TRUE(io::read_image(path("still.png"), still).ok());
  ASSERT_TRUE(io::read_image(path("key.0001.png"), first).ok());
  ASSERT_TRUE(io::read_image(path("key.-007.png"), before).ok());
  ASSERT_TRUE(io::read_image(path("key.0099.png"), after).ok());
  EXPECT_EQ(still.pixels, first.pixels);
  EXPECT_EQ(before.pixels, first.pixels);
  EXPECT_NE(after.pixels, first.pixels);
}

TEST_F(Sequence, AnimatedCameraIsWhereItsFramesTimeSays) {
  write_animated_scene();
  const std::vector<std::string> common = {"render", path("moving.gltf"), "-q", "--size", "16x8", "-o"};
  const auto go = [&](std::vector<std::string> more) {
    more.insert(more.begin(), common.begin(), common.end());
    return run(more).code;
  };
  ASSERT_EQ(go({path("a.##.exr"), "--frames", "0,12,48,96"}), 0);
  EXPECT_NEAR(camera_x("a.00.exr"), 0, 1e-6);
  EXPECT_NEAR(camera_x("a.12.exr"), 1, 1e-6);
  EXPECT_NEAR(camera_x("a.48.exr"), 4, 1e-6);
  EXPECT_NEAR(camera_x("a.96.exr"), 4, 1e-6);
  ASSERT_EQ(go({path("b.##.exr"), "--frames", "12", "--fps", "12.5"}), 0);
  EXPECT_NEAR(camera_x("b.12.exr"), 12 / 12.5 * 2, 1e-6);
  ASSERT_EQ(go({path("rest.exr")}), 0);
  EXPECT_EQ(camera_x("rest.exr"), 0);
  EXPECT_EQ(Json::parse(run({"info", path("moving.gltf"), "--json"}).out)["cameras"][0]["moves_seconds"], Json({0, 2}));
}

TEST_F(Sequence, NumbersArePaddedAndMayBeWider) {
  ASSERT_EQ(render("7,12345,7", "#.png", {"-o", path("a_####_b.exr"), "-o", path("%06d.png")}).code, 0);
  const std::vector<std::string> wanted = {"000007.png",    "012345.png", "12345.png", "7.png",     "a_0007_b.exr",
                                           "a_12345_b.exr", "orbit.json", "scene.bin", "scene.gltf"};
  EXPECT_EQ(files(), wanted);
}

TEST_F(Sequence, WrongUsageIsTwoAndSaysWhatIsWrong) {
  struct Case {
    std::string frames, output, said;
    std::vector<std::string> more;
  };
  const Case cases[] = {
      {"", "a.####.exr", "--frames", {}},
      {"", "a.%04d.exr", "--frames", {}},
      {"1-3", "a.exr", "####", {}},
      {"1-3", "a.%4d.exr", "####", {}},
      {"1", "a.##.%d.exr", "more than one place", {}},
      {"1-3", "a.####.exr", "twice", {"-o", path("a.%04d.exr")}},
      {"1-3", "a.####.exr", "twice", {"-o", path("b.###.exr"), "--stats", path("b.002.exr")}},
      {"3-1", "a.####.exr", "'3-1' ends before", {}},
      {"1-5:0", "a.####.exr", "'1-5:0' is not", {}},
      {"1-5y2", "a.####.exr", "'1-5y2' is not", {}},
      {"1,,2", "a.####.exr", "'' is not", {}},
      {"1-", "a.####.exr", "'1-' is not", {}},
      {"1.5", "a.####.exr", "'1.5' is not", {}},
      {"1 2", "a.####.exr", "'1 2' is not", {}},
      {"1000000", "a.####.exr", "999999", {}},
      {"99999999999999999999", "a.####.exr", "999999", {}},
      {"-999999-999999", "a.####.exr", "more than 100000 frames", {}},
      {"1-2", "a.####.exr", "from 0.001", {"--fps", "0"}},
      {"", "a.exr", "--frames", {"--fps", "30"}},
      {"1", "a.exr", "--overwrite", {"--overwrite", "--skip-existing"}},
  };
  const std::vector<std::string> before = files();
  for (const Case& c : cases) {
    const Outcome outcome = render(c.frames, c.output, c.more);
    EXPECT_EQ(outcome.code, 2) << c.frames << " " << c.output << ": " << outcome.err;
    EXPECT_TRUE(contains(outcome.err, c.said)) << c.frames << " " << c.output << ": " << outcome.err;
    EXPECT_EQ(files(), before);
  }
}

TEST_F(Sequence, OneFrameNeedsNoPattern) { EXPECT_EQ(render("3", "a.exr").code, 0); }

TEST_F(Sequence, AFileInTheWayIsFourBeforeAnyFrame) {
  write("out.0003.exr", "precious");
  const std::vector<std::string> before = files();
  const Outcome outcome = render("1-3", "out.####.exr");
  EXPECT_EQ(outcome.code, 4);
  EXPECT_TRUE(contains(outcome.err, "out.0003.exr")) << outcome.err;
  EXPECT_EQ(files(), before);
  EXPECT_EQ(render("1-3", "out.####.exr", {"--overwrite"}).code, 0);
  EXPECT_NE(read("out.0003.exr"), "precious");
}

TEST_F(Sequence, SkippingLeavesWhatExistsAndRendersWhatIsMissing) {
  ASSERT_EQ(render("1-3", "whole.####.exr", {"-o", path("whole.####.png")}).code, 0);
  write("out.0002.exr", "kept");
  write("out.0003.exr", "kept");
  write("out.0003.png", "kept");
  const std::vector<std::string> more = {"-o", path("out.####.png"), "--skip-existing", "--stats"};
  std::vector<std::string> first = more, second = more;
  first.push_back(path("first.json"));
  second.push_back(path("second.json"));
  ASSERT_EQ(render("1-3", "out.####.exr", first).code, 0);
  for (const char* name : {"0001.exr", "0001.png", "0002.png"}) {
    EXPECT_TRUE(read(std::string("out.") + name) == read(std::string("whole.") + name)) << name;
  }
  for (const char* name : {"0002.exr", "0003.exr", "0003.png"}) EXPECT_EQ(read(std::string("out.") + name), "kept");
  const Json stats = Json::parse(read("first.json"));
  EXPECT_EQ(stats["skipped_frames"], 1);
  EXPECT_EQ(stats["frames"].size(), 2u);
  EXPECT_EQ(stats["frames"][1]["outputs"], Json({path("out.0002.png")}));

  ASSERT_EQ(render("1-3", "out.####.exr", second).code, 0);
  EXPECT_EQ(Json::parse(read("second.json"))["skipped_frames"], 3);
  EXPECT_TRUE(Json::parse(read("second.json"))["frames"].empty());
  ASSERT_EQ(render("1-3", "out.####.exr", first).code, 0) << "a command may be repeated";
  EXPECT_EQ(Json::parse(read("first.json")), stats) << "nothing was done, so nothing is reported";
}

TEST_F(Sequence, AFrameWithoutADirectionIsThreeBeforeAnyFrame) {
  write("orbit.json", R"({"camera": {"keyframes": [
    {"frame": 1, "eye": [0, 0, 4], "target": [0, 0, 0]}, {"frame": 5, "eye": [0, 0, -4]}]}})");
  const std::vector<std::string> before = files();
  const Outcome outcome = render("1-5", "out.####.exr");
  EXPECT_EQ(outcome.code, 3);
  EXPECT_TRUE(contains(outcome.err, "orbit.json: frame 3: ")) << outcome.err;
  EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << outcome.err;
  EXPECT_EQ(files(), before);
  EXPECT_EQ(render("1-2,4-5", "out.####.exr").code, 0);
}

TEST_F(Sequence, StatsOfFramesAddUp) {
  ASSERT_EQ(render("4-6", "out.####.exr", {"--stats", path("stats.json"), "--fps", "2"}).code, 0);
  const Json stats = Json::parse(read("stats.json"));
  EXPECT_EQ(stats["fps"], 2);
  ASSERT_EQ(stats["frames"].size(), 3u);
  EXPECT_EQ(stats["frames"][1]["frame"], 5);
  EXPECT_EQ(stats["frames"][1]["time"], 2.5);
  EXPECT_EQ(stats["frames"][1]["outputs"], Json({path("out.0005.exr")}));
  int camera = 0, shadow = 0, lamp = 0, hits = 0, routes = 0;
  double seconds = 0;
  for (const Json& frame : stats["frames"]) {
    EXPECT_EQ(frame["camera"]["rays"], 32 * 16);
    camera += frame["camera"]["rays"].get<int>();
    hits += frame["camera"]["hits"].get<int>();
    shadow += frame["shadow"]["rays"].get<int>();
    lamp += frame["lights"][0]["rays"].get<int>();
    routes += frame["shadow"]["routes"]["other"].get<int>();
    seconds += frame["seconds"]["render"].get<double>();
  }
  EXPECT_EQ(stats["camera"]["rays"], camera);
  EXPECT_EQ(stats["camera"]["hits"], hits);
  EXPECT_EQ(stats["shadow"]["rays"], shadow);
  EXPECT_EQ(stats["lights"][0]["rays"], lamp);
  EXPECT_EQ(stats["shadow"]["routes"]["other"], routes);
  EXPECT_NEAR(stats["seconds"]["render"].get<double>(), seconds, 1e-9);
  EXPECT_EQ(stats["build"]["triangles"], 4);
}

TEST_F(Sequence, ProgressIsOneLineAFrame) {
  const std::vector<std::string> common = {"render", path("scene.gltf"), "--size", "8x8", "--frames", "3-5", "-o"};
  std::vector<std::string> lines = common, bar = common;
  lines.insert(lines.end(), {path("a.#.png"), "--progress", "lines"});
  bar.insert(bar.end(), {path("b.#.png"), "--progress", "bar"});
  const Outcome plain = run(lines);
  EXPECT_TRUE(contains(plain.err, "umbrix: frame 4 done, 2 of 3")) << plain.err;
  EXPECT_TRUE(contains(plain.err, "frames  3 rendered, 0 skipped")) << plain.err;
  EXPECT_TRUE(contains(plain.err, "nothing moves")) << plain.err;
  EXPECT_TRUE(contains(run(bar).err, "100% frame 3 of 3")) << plain.err;
}

TEST_F(Sequence, AnInterruptionLeavesWholeFiles) {
  const pid_t process = start({"render", path("scene.gltf"), "--setup", path("orbit.json"), "-q", "-o",
                               path("out.######.exr"), "-o", path("out.######.png"), "--heat-map",
                               "depth=" + path("out.######.depth.png"), "--size", "32x16", "--frames", "1-9000"});
  while (!exists("out.000003.exr")) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  kill(process, SIGTERM);
  EXPECT_EQ(wait(process).code, 143);
  const std::vector<std::string> left = files();
  ASSERT_LT(left.size(), 27000u);
  std::size_t exr = 0, png = 0, heat = 0, other = 0;
  for (const std::string& name : left) {
    io::Image image;
    if (name.rfind("out.", 0) != 0) continue;
    EXPECT_TRUE(io::read_image(path(name), image).ok()) << name;
    ++(contains(name, ".exr") ? exr : contains(name, ".depth.png") ? heat : contains(name, ".png") ? png : other);
  }
  EXPECT_GE(exr, 3u);
  // In the order of writing, and of one frame at most not all: --skip-existing renders it again.
  EXPECT_TRUE(exr >= png && png >= heat && exr <= heat + 1) << exr << " " << png << " " << heat;
  EXPECT_EQ(other, 0u);
}

}  // namespace
}  // namespace umbrix::app
