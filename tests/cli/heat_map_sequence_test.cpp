// SPDX-License-Identifier: Apache-2.0
// Heat maps of sequences: files of their frames as images are, and colours that compare.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "program.h"
#include "umbrix/io/image_file.h"

namespace umbrix::app {
namespace {

using Json = nlohmann::json;

const char* const kRetreat = R"({"camera": {"keyframes": [
  {"frame": 1, "eye": [0, 0, 4], "target": [0, 0, 0], "fov_y_degrees": 40}, {"frame": 3, "eye": [0, 0, 8]}]}})";

class HeatMapSequence : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write_scene();
    write("retreat.json", kRetreat);
    before_ = files();
  }

  Outcome render(const std::string& frames, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"render", path("scene.gltf"), "--setup", path("retreat.json"),
                                          "-q",     "--size",           "32x16",   "--frames=" + frames};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }

  std::string map(const std::string& aov, const std::string& name) const { return aov + "=" + path(name); }

  io::Image image(const std::string& name) const {
    io::Image result;
    const Status status = io::read_image(path(name), result);
    EXPECT_TRUE(status.ok()) << status.message();
    return result;
  }

  /// A frame's depths, each with the green that its heat map shows it in: more is deeper, if the scale is the same.
  void add_greens(const std::string& exr, const std::string& png, std::vector<std::pair<float, float>>& out) const {
    const io::Image values = image(exr), picture = image(png);
    ASSERT_EQ(values.channels.back(), "depth.Z");
    for (std::size_t y = 0; y < 16; ++y) {
      for (std::size_t x = 0; x < 32; ++x) {
        const std::size_t shown = (y * static_cast<std::size_t>(picture.width) + x) * picture.channels.size();
        const float depth = values.pixels[(y * 32 + x + 1) * values.channels.size() - 1];
        if (depth < 100) out.emplace_back(depth, picture.pixels[shown + 1]);
      }
    }
  }

  std::vector<std::string> before_;
};

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_F(HeatMapSequence, EachFrameHasItsOwnInAnyRun) {
  ASSERT_EQ(render("1-3", {"--heat-map", map("depth", "a.####.png"), "--heat-map", map("shadow", "s.%d.png")}).code, 0);
  ASSERT_EQ(render("2", {"--heat-map", map("depth", "b.####.png"), "-o", path("b.#.png")}).code, 0);
  EXPECT_TRUE(read("a.0002.png") == read("b.0002.png"));
  EXPECT_FALSE(read("a.0001.png") == read("a.0003.png"));
  for (const char* name : {"a.0003.png", "s.1.png", "s.3.png", "b.2.png"}) EXPECT_TRUE(exists(name)) << name;
  EXPECT_EQ(files().size(), before_.size() + 8);
}

TEST_F(HeatMapSequence, ColoursCompareWithOneEndForAll) {
  const std::vector<std::string> more = {"-o",         path("out.#.exr"),         "--float", "--heat-max", "depth=10.5",
                                         "--heat-map", map("depth", "heat.#.png")};
  ASSERT_EQ(render("1,3", more).code, 0);
  std::vector<std::pair<float, float>> greens;
  add_greens("out.1.exr", "heat.1.png", greens);
  const std::size_t first = greens.size();
  add_greens("out.3.exr", "heat.3.png", greens);
  ASSERT_GT(first, 100u);
  ASSERT_GT(greens.size(), first + 50);
  EXPECT_LT(*std::max_element(greens.begin(), greens.begin() + static_cast<std::ptrdiff_t>(first)), greens.back());
  std::sort(greens.begin(), greens.end());
  EXPECT_TRUE(std::is_sorted(greens.begin(), greens.end(), [](auto a, auto b) { return a.second < b.second; }));

  ASSERT_EQ(render("1", {"--heat-map", map("depth", "own.png")}).code, 0);
  EXPECT_FALSE(read("heat.1.png") == read("own.png")) << "the frame's own scale ends at 4";
}

TEST_F(HeatMapSequence, AFileInTheWayIsFourBeforeAnyFrame) {
  write("heat.0003.png", "precious");
  const std::vector<std::string> left = files();
  const std::vector<std::string> more = {"-o", path("out.####.png"), "--heat-map", map("depth", "heat.####.png")};
  const Outcome outcome = render("1-3", more);
  EXPECT_EQ(outcome.code, 4);
  EXPECT_TRUE(contains(outcome.err, "heat.0003.png")) << outcome.err;
  EXPECT_EQ(files(), left);
}

TEST_F(HeatMapSequence, SkippingCountsThemAmongAFramesFiles) {
  const std::vector<std::string> more = {"-o",      path("out.#.exr"),  "--heat-map",     map("depth", "heat.#.png"),
                                         "--stats", path("stats.json"), "--skip-existing"};
  for (const char* name : {"out.1.exr", "heat.1.png", "heat.2.png", "out.3.exr"}) write(name, "kept");
  ASSERT_EQ(render("1-4", more).code, 0);
  for (const char* name : {"out.1.exr", "heat.1.png", "heat.2.png", "out.3.exr"}) EXPECT_EQ(read(name), "kept") << name;
  EXPECT_EQ(image("out.2.exr").channels, image("out.4.exr").channels) << "an image does not depend on what is skipped";
  const Json stats = Json::parse(read("stats.json"));
  EXPECT_EQ(stats["skipped_frames"], 1);
  EXPECT_EQ(stats["outputs"], Json({path("out.#.exr"), path("heat.#.png")}));
  ASSERT_EQ(stats["frames"].size(), 3u);
  EXPECT_EQ(stats["frames"][0]["outputs"], Json({path("out.2.exr")}));
  EXPECT_EQ(stats["frames"][1]["outputs"], Json({path("heat.3.png")}));
  EXPECT_EQ(stats["frames"][2]["outputs"], Json({path("out.4.exr"), path("heat.4.png")}));
}

TEST_F(HeatMapSequence, DryRunNamesThePattern) {
  const Outcome outcome = render("1-3", {"--heat-map", map("depth", "heat.#.png"), "--dry-run"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(contains(outcome.out, "would write " + path("heat.#.png") + ", 3 frames")) << outcome.out;
  EXPECT_EQ(files(), before_);
}

TEST_F(HeatMapSequence, WrongPatternsAndEndsAreUsageErrors) {
  struct Case {
    std::vector<std::string> more;
    const char* said;
  };
  const std::string depth = map("depth", "heat.#.png");
  const Case cases[] = {
      {{"--heat-map", map("depth", "heat.png")}, "such as name.####.png"},
      {{"--heat-map", map("depth", "heat.#.#.png")}, "more than one place"},
      {{"--heat-map", depth, "-o", path("heat.%d.png")}, "twice"},
      {{"--heat-map", depth, "--heat-max", "shadow=1"}, "no --heat-map shows 'shadow'"},
      {{"--heat-map", map("kernel", "heat.#.png"), "--heat-max", "kernel=1"}, "'kernel' has no scale"},
      {{"--heat-map", depth, "--heat-max", "depth=1", "--heat-max", "depth=1"}, "twice"},
      {{"--heat-map", depth, "--heat-max", "depth"}, "AOV=X"},
      {{"--heat-map", depth, "--heat-max", "depth=0"}, "AOV=X"},
      {{"--heat-map", depth, "--heat-max", "depth=-1"}, "AOV=X"},
      {{"--heat-map", depth, "--heat-max", "depth=nan"}, "AOV=X"},
  };
  for (const Case& c : cases) {
    const Outcome outcome = render("1-2", c.more);
    EXPECT_EQ(outcome.code, 2) << c.said;
    EXPECT_TRUE(contains(outcome.err, c.said)) << outcome.err;
  }
  EXPECT_EQ(files(), before_);
}

}  // namespace
}  // namespace umbrix::app
