// SPDX-License-Identifier: Apache-2.0
// --config: the same names as the flags, the command line first, and messages that name the file.
#include "program.h"
#include "umbrix/io/image_file.h"

namespace umbrix::app {
namespace {

class Config : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write_scene();
  }

  Outcome render(const std::string& config, const std::vector<std::string>& more = {}) {
    write("job.toml", config);
    std::vector<std::string> arguments = {"render", path("scene.gltf"), "-q", "--config", path("job.toml")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
};

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_F(Config, IsAsTheSameOnTheCommandLine) {
  const std::string outputs = "output = [\"" + path("a.exr") + "\", \"" + path("a.png") + "\"]\n";
  const std::string heat = "heat-max = \"depth=4\"\nheat-map = \"depth=" + path("heat.png") + "\"\n";
  const Outcome outcome =
      render("# a comment\nsize = \"24x16\"\nspp = 3\nfloat = true\nno-mesh-lights = false\naov = \"depth\"\n" +
             outputs + heat);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  ASSERT_EQ(
      run({"render", path("scene.gltf"), "-q", "--size", "24x16", "--spp", "3", "--float", "--aov", "depth", "-o",
           path("b.exr"), "-o", path("b.png"), "--heat-map", "depth=" + path("heat_b.png"), "--heat-max", "depth=4"})
          .code,
      0);
  EXPECT_TRUE(read("a.exr") == read("b.exr"));
  EXPECT_TRUE(read("a.png") == read("b.png"));
  EXPECT_TRUE(read("heat.png") == read("heat_b.png"));
}

TEST_F(Config, TheCommandLineComesFirst) {
  ASSERT_EQ(render("size = \"24x16\"\nseed = 4\n", {"-o", path("a.exr"), "--size", "10x8"}).code, 0);
  io::Image image;
  ASSERT_TRUE(io::read_image(path("a.exr"), image).ok());
  EXPECT_EQ(image.width, 10);
  ASSERT_EQ(run({"render", path("scene.gltf"), "-q", "-o", path("b.exr"), "--size", "10x8", "--seed", "4"}).code, 0);
  EXPECT_TRUE(read("a.exr") == read("b.exr"));
}

TEST_F(Config, WrongFilesAreTwoAndNamed) {
  const auto check = [&](const Outcome& outcome, const std::string& said) {
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, "job.toml")) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, said)) << outcome.err;
    EXPECT_FALSE(exists("a.exr"));
  };
  const std::vector<std::string> output = {"-o", path("a.exr")};
  check(render("sp = 3\n", output), "'sp'");
  check(render("spp = 0\n", output), "from 1 to 65536");
  check(render("spp = 3\nseed = 1\nspp = 4\n", output), "'spp' is there twice");
  check(render("spp = [3, 4]\n", output), "--spp");
  check(render("overwrite = 7\n", output), "'overwrite' is true or false");
  check(render("[render]\nspp = 3\n", output), "[render]");
  check(render("config = \"x\"\n", output), "'config'");
  std::filesystem::remove(path("job.toml"));
  check(run({"render", path("scene.gltf"), "--config", path("job.toml"), "-o", path("a.exr")}), "--config");
}

}  // namespace
}  // namespace umbrix::app
