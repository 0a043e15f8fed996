// SPDX-License-Identifier: Apache-2.0
// Parts of frames: tiles, crops and pixels show what the whole frame shows, and merged tiles are the frame's file.
#include <algorithm>
#include <fstream>

#include "program.h"
#include "umbrix/io/image_file.h"

namespace umbrix::app {
namespace {

class Tiles : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write_scene();
  }

  Outcome render(const std::string& output, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"render", path("scene.gltf"), "-q", "-o", path(output)};
    if (std::find(more.begin(), more.end(), "--size") == more.end())
      arguments.insert(arguments.end(), {"--size", "50x31"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }

  void render_tiles(const std::string& output, int count, const std::vector<std::string>& more = {}) {
    for (int i = 0; i < count; ++i) {
      std::vector<std::string> arguments = {"--tile", std::to_string(i) + "/" + std::to_string(count)};
      arguments.insert(arguments.end(), more.begin(), more.end());
      const Outcome outcome = render(output, arguments);
      ASSERT_EQ(outcome.code, 0) << outcome.err;
    }
  }

  /// The files whose names begin so, in order.
  std::vector<std::string> paths_of(const std::string& begin) const {
    std::vector<std::string> paths;
    for (const std::string& name : files()) {
      if (name.rfind(begin, 0) == 0) paths.push_back(path(name));
    }
    return paths;
  }

  Outcome merge(std::vector<std::string> words, const std::string& output) {
    words.insert(words.begin(), "merge");
    words.insert(words.end(), {"-q", "-o", path(output)});
    return run(words);
  }

  io::Image image(const std::string& name) const {
    io::Image result;
    const Status status = io::read_image(path(name), result);
    EXPECT_TRUE(status.ok()) << status.message();
    return result;
  }

  void flip_bit(const std::string& name, std::size_t at) const {
    std::string bytes = read(name);
    bytes.at(at) = static_cast<char>(bytes[at] ^ 0x10);
    write(name, bytes);
  }
};

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_F(Tiles, MergeToTheBytesOfTheWholeFrame) {
  struct Case {
    int count;
    std::vector<std::string> more;
  };
  // A prime, a square, one; colour alone and channels of both types; halves and floats.
  const Case cases[] = {{7, {"--spp", "2"}}, {9, {"--aov", "depth,normal", "--seed", "5"}}, {1, {"--float"}}};
  for (const Case& c : cases) {
    const std::string name = "t" + std::to_string(c.count);
    ASSERT_EQ(render(name + ".whole.exr", c.more).code, 0);
    render_tiles(name + ".exr", c.count, c.more);
    std::vector<std::string> tiles = paths_of(name + ".tile");
    ASSERT_EQ(tiles.size(), static_cast<std::size_t>(c.count));
    std::reverse(tiles.begin(), tiles.end());
    const Outcome outcome = merge(tiles, name + ".exr");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(read(name + ".exr") == read(name + ".whole.exr")) << name;
  }
}

TEST_F(Tiles, CutTheFrameIntoNearSquaresWithoutGapOrOverlap) {
  render_tiles("t.exr", 6, {"--size", "60x41"});
  std::vector<int> covered(60 * 41);
  for (int i = 0; i < 6; ++i) {
    const io::Image tile = image("t.tile00" + std::to_string(i) + "of006.exr");
    EXPECT_EQ(tile.frame_width, 60);
    EXPECT_EQ(tile.frame_height, 41);
    EXPECT_EQ(tile.width, 20);
    EXPECT_EQ(tile.x, 20 * (i % 3)) << "row by row";
    for (int y = 0; y < tile.height; ++y) {
      for (int x = 0; x < tile.width; ++x) ++covered[static_cast<std::size_t>((tile.y + y) * 60 + tile.x + x)];
    }
  }
  EXPECT_TRUE(std::all_of(covered.begin(), covered.end(), [](int count) { return count == 1; }));
}

TEST_F(Tiles, MergeNamesWhatIsMissing) {
  render_tiles("t.exr", 4);
  std::filesystem::remove(path("t.tile002of004.exr"));
  const Outcome listed = merge(paths_of("t.tile"), "t.exr");
  const Outcome named = merge({"--tiles", "4", "--progress", "openjd"}, "t.exr");
  for (const Outcome& outcome : {listed, named}) {
    EXPECT_EQ(outcome.code, 5);
    EXPECT_TRUE(contains(outcome.err, "t.exr: 1 of 4 tiles missing: 2")) << outcome.err;
  }
  EXPECT_TRUE(contains(named.out, "openjd_fail: ")) << named.out;
  EXPECT_FALSE(exists("t.exr"));
  EXPECT_EQ(merge({"--tiles", "3"}, "none.exr").code, 5);
}

TEST_F(Tiles, MergeRefusesWhatDoesNotGoTogether) {
  render_tiles("t.exr", 2);
  render_tiles("seed.exr", 2, {"--seed", "7"});
  render_tiles("three.exr", 3);
  ASSERT_EQ(render("whole.exr").code, 0);
  const std::string first = path("t.tile000of002.exr"), second = path("t.tile001of002.exr");
  write("cut.exr", read("t.tile001of002.exr").substr(0, 900));
  struct Case {
    std::string other, said;
  };
  const Case cases[] = {{first, "is tile 0/2, as is"},
                        {path("seed.tile001of002.exr"), "umbrix:job differs"},
                        {path("three.tile001of003.exr"), "number of tiles differs"},
                        {path("whole.exr"), "is no tile"},
                        {path("cut.exr"), "cut.exr"},
                        {path("scene.gltf"), "scene.gltf"},
                        {path("absent.exr"), "absent.exr"}};
  for (const Case& c : cases) {
    const Outcome outcome = merge({first, c.other}, "out.exr");
    EXPECT_EQ(outcome.code, 3) << c.other;
    EXPECT_TRUE(contains(outcome.err, c.said)) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, c.other)) << outcome.err;
    EXPECT_FALSE(exists("out.exr"));
  }
  ASSERT_EQ(merge({first, second}, "out.exr").code, 0);
  EXPECT_EQ(merge({first, second}, "out.exr").code, 4) << "it exists";
  EXPECT_EQ(merge({first, second, "--overwrite", "--memory-limit", "1G"}, "out.exr").code, 0);
  EXPECT_EQ(merge({first, second, "--overwrite"}, "t.tile000of002.exr").code, 4) << "an input";
}

TEST_F(Tiles, MergeNoticesASingleBit) {
  // Pixels of a picture this small are not compressed, so OpenEXR has no checksum of them.
  render_tiles("t.exr", 2, {"--size", "2x1", "--float"});
  const std::string good = read("t.tile001of002.exr");
  flip_bit("t.tile001of002.exr", good.size() - 5);
  const Outcome outcome = merge(paths_of("t.tile"), "t.exr");
  EXPECT_EQ(outcome.code, 3);
  EXPECT_TRUE(contains(outcome.err, "t.tile001of002.exr: is damaged")) << outcome.err;
}

TEST_F(Tiles, MergeSequencesByTheNamesOfRender) {
  for (const char* tile : {"0/2", "1/2"}) {
    ASSERT_EQ(render("f.####.exr", {"--frames", "1,3", "--tile", tile}).code, 0);
  }
  EXPECT_EQ(paths_of("f.").size(), 4u);
  ASSERT_EQ(render("whole.####.exr", {"--frames", "1,3"}).code, 0);
  ASSERT_EQ(merge({"--tiles", "2", "--frames", "1,3"}, "f.####.exr").code, 0);
  for (const char* frame : {"0001", "0003"}) {
    EXPECT_TRUE(read(std::string("f.") + frame + ".exr") == read(std::string("whole.") + frame + ".exr")) << frame;
  }
  // What is there is merged, whatever is not.
  const Outcome outcome = merge({"--tiles", "2", "--frames", "1-3", "--overwrite"}, "f.####.exr");
  EXPECT_EQ(outcome.code, 5);
  EXPECT_TRUE(contains(outcome.err, "f.0002.exr: 2 of 2 tiles missing: 0, 1")) << outcome.err;
}

TEST_F(Tiles, WrongUsageOfMergeIsTwo) {
  const std::vector<std::vector<std::string>> cases = {{"-o", path("a.exr")},
                                                       {path("t.exr")},
                                                       {path("t.exr"), "-o", path("a.png")},
                                                       {path("t.exr"), "-o", path("a.exr"), "--tiles", "4"},
                                                       {path("t.exr"), "-o", path("a.####.exr"), "--frames", "1"},
                                                       {"--tiles", "4", "-o", path("a.exr"), "--frames", "1-2"},
                                                       {"--tiles", "4", "-o", path("a.####.exr")},
                                                       {"--tiles", "0", "-o", path("a.exr")},
                                                       {"--tiles", "4", "-o", path("a.exr"), "--frames", "x"},
                                                       {"--tiles", "4", "-o", path("a.exr"), "--progress", "loud"}};
  for (std::vector<std::string> words : cases) {
    words.insert(words.begin(), "merge");
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 2) << words.back() << outcome.err;
  }
}

TEST_F(Tiles, WrongUsageOfRenderIsTwoAndNamesTheFlag) {
  struct Case {
    std::vector<std::string> more;
    std::string said;
  };
  const Case cases[] = {{{"--tile", "4/4"}, "--tile: '4/4'"},
                        {{"--tile", "1"}, "--tile: '1'"},
                        {{"--tile", "0/0"}, "--tile: '0/0'"},
                        {{"--tile", "0/99999999"}, "--tile: '0/99999999'"},
                        {{"--tile", "0/53", "--size", "50x31"}, "--tile: an image of 50x31"},
                        {{"--tile", "0/2", "--crop", "4x4+0+0"}, "--crop"},
                        {{"--tile", "0/2", "-o", path("a.png")}, "a.png"},
                        {{"--tile", "0/2", "--heat-map", "depth=" + path("a.png")}, "--heat-map"},
                        {{"--pixel", "3"}, "--pixel: '3'"},
                        {{"--pixel", "50,0"}, "--pixel: "},
                        {{"--crop", "4,4,4,9"}, "--crop: '4,4,4,9'"},
                        {{"--crop", "1,2,51,3"}, "--crop: "}};
  for (const Case& c : cases) {
    const Outcome outcome = render("a.exr", c.more);
    EXPECT_EQ(outcome.code, 2) << c.said << outcome.err;
    EXPECT_TRUE(contains(outcome.err, c.said)) << outcome.err;
  }
}

TEST_F(Tiles, CropsKeepTheirPlaceInTheFrame) {
  ASSERT_EQ(render("a.exr", {"--crop", "20x10+7+9"}).code, 0);
  ASSERT_EQ(render("b.exr", {"--crop", "7,9,27,19"}).code, 0);
  EXPECT_TRUE(read("a.exr") == read("b.exr"));
  const io::Image crop = image("a.exr");
  EXPECT_EQ(crop.x, 7);
  EXPECT_EQ(crop.y, 9);
  EXPECT_EQ(crop.width, 20);
  EXPECT_EQ(crop.frame_width, 50);
  EXPECT_EQ(crop.frame_height, 31);
}

TEST_F(Tiles, PixelPrintsWhatTheFrameHasThere) {
  ASSERT_EQ(render("whole.exr", {"--float", "--aov", "depth"}).code, 0);
  const Outcome outcome =
      run({"render", path("scene.gltf"), "-q", "--size", "50x31", "--aov", "depth", "--pixel", "12,9"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  float r = 0, z = 0;
  ASSERT_EQ(std::sscanf(outcome.out.c_str(), "pixel 12,9: R %f G %*f B %*f A %*f depth.Z %f", &r, &z), 2)
      << outcome.out;
  const io::Image whole = image("whole.exr");
  EXPECT_EQ(r, whole.pixels[(9 * 50 + 12) * 5]);
  EXPECT_EQ(z, whole.pixels[(9 * 50 + 12) * 5 + 4]);
}

}  // namespace
}  // namespace umbrix::app
