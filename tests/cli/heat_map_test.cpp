// SPDX-License-Identifier: Apache-2.0
// --heat-map: pictures of a real render, and what is refused.
#include <algorithm>

#include "program.h"
#include "umbrix/io/image_file.h"

namespace umbrix::app {
namespace {

class HeatMapFiles : public ProgramTest {
 protected:
  Outcome render(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"render", UMBRIX_CORNELL, "-q", "--size", "64x64", "--overwrite"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }

  std::string map(const std::string& aov, const std::string& name) const { return aov + "=" + path(name); }

  io::Image image(const std::string& name) {
    io::Image result;
    const Status status = io::read_image(path(name), result);
    EXPECT_TRUE(status.ok()) << status.message();
    return result;
  }
};

std::size_t pixel(const io::Image& image, int x, int y) {
  return static_cast<std::size_t>(y * image.width + x) * image.channels.size();
}

TEST_F(HeatMapFiles, PictureOfARenderKeepsTheOrderOfItsValues) {
  ASSERT_EQ(render({"-o", path("out.exr"), "--float", "--heat-map", map("primitive_tests", "heat.png")}).code, 0);
  const io::Image values = image("out.exr"), picture = image("heat.png");
  ASSERT_EQ(values.channels.back(), "primitive_tests.Y") << "the AOV was rendered, though not asked for by --aov";
  ASSERT_EQ(picture.channels.size(), 3u);
  EXPECT_GE(picture.width, 64);
  EXPECT_GT(picture.height, 64 + 40);

  // Viridis grows lighter throughout; its green does so alone. More tests are never less green.
  std::vector<std::pair<float, float>> pairs;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      pairs.emplace_back(values.pixels[pixel(values, x, y) + 4], picture.pixels[pixel(picture, x, y) + 1]);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  EXPECT_LT(pairs.front().second, pairs.back().second);
  EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end(), [](auto a, auto b) { return a.second < b.second; }));
  EXPECT_NEAR(pairs.back().second, 231 / 255.0, 1e-6) << "the largest has the last colour";
}

TEST_F(HeatMapFiles, NeedsNoOtherOutputAndNoExr) {
  ASSERT_EQ(
      render({"--heat-map", map("node_tests", "n.png"), "--heat-map", map("kernel", "k.png"), "--crop", "40x20+9+9"})
          .code,
      0);
  EXPECT_EQ(files(), (std::vector<std::string>{"k.png", "n.png"}));
  EXPECT_GT(image("n.png").height, 20);
  EXPECT_GT(image("k.png").height, 20);
  ASSERT_EQ(render({"-o", path("out.png"), "--heat-map", map("shadow", "s.PNG")}).code, 0);
  EXPECT_EQ(image("out.png").height, 64);
}

TEST_F(HeatMapFiles, ColoursAreNotExposed) {
  ASSERT_EQ(render({"--heat-map", map("depth", "a.png")}).code, 0);
  ASSERT_EQ(render({"--heat-map", map("depth", "b.png"), "--exposure", "2", "--tonemap", "aces"}).code, 0);
  EXPECT_TRUE(read("a.png") == read("b.png"));
}

TEST_F(HeatMapFiles, BadRequestsAreUsageErrors) {
  struct Case {
    std::vector<std::string> more;
    const char* said;
  };
  const Case cases[] = {
      {{"--heat-map", map("colour", "a.png")}, "node_tests, primitive_tests, kernel"},
      {{"--heat-map", map("normal", "a.png")}, "'normal'"},
      {{"--heat-map", path("a.png")}, "AOV=FILE.png"},
      {{"--heat-map", "depth="}, "AOV=FILE.png"},
      {{"--heat-map", map("depth", "a.png"), "--heat-map", map("shadow", "./a.png")}, "twice"},
      {{"--heat-map", map("depth", "a.png"), "-o", path("a.png")}, "twice"},
      {{}, "--heat-map"},
  };
  for (const Case& c : cases) {
    const Outcome outcome = render(c.more);
    EXPECT_EQ(outcome.code, 2) << c.said;
    EXPECT_NE(outcome.err.find(c.said), std::string::npos) << outcome.err;
  }
  EXPECT_TRUE(files().empty());
}

TEST_F(HeatMapFiles, ImpossibleFilesAreFourBeforeAnyWork) {
  write("old.png", "precious");
  for (const char* name : {"a.exr", "a", "nowhere/a.png", "old.png"}) {
    const Outcome outcome = run({"render", path("absent.glb"), "--heat-map", map("depth", name)});
    EXPECT_EQ(outcome.code, 4) << name;
    EXPECT_NE(outcome.err.find(name), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(read("old.png"), "precious");
  EXPECT_EQ(render({"--heat-map", map("depth", "old.png")}).code, 0) << "--overwrite";
  EXPECT_EQ(render({"--heat-map", map("depth", "new/a.png"), "--create-dir"}).code, 0);
  EXPECT_TRUE(exists("new/a.png"));
}

TEST_F(HeatMapFiles, DryRunNamesTheFile) {
  const Outcome outcome = render({"--heat-map", map("depth", "a.png"), "--dry-run"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.out.find("would write " + path("a.png")), std::string::npos) << outcome.out;
  EXPECT_FALSE(exists("a.png"));
}

}  // namespace
}  // namespace umbrix::app
