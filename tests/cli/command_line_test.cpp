// SPDX-License-Identifier: Apache-2.0
// What the command line accepts, and the exit code and message for what it does not.
#include <algorithm>

#include "program.h"

namespace umbrix::app {
namespace {

class CommandLine : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write_scene();
  }

  /// A render of the scene to out.exr, small if nothing is said about size, with more arguments.
  Outcome render(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"render", path("scene.gltf"), "-o", path("out.exr")};
    if (std::find(more.begin(), more.end(), "--size") == more.end())
      arguments.insert(arguments.end(), {"--size", "16x8"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
};

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_F(CommandLine, HelpAndVersionSucceedOnStdout) {
  for (const char* flag : {"--help", "--version"}) {
    const Outcome outcome = run({flag});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_TRUE(contains(outcome.out, "mbrix")) << outcome.out;
    EXPECT_EQ(outcome.err, "");
  }
  EXPECT_TRUE(contains(run({"render", "--help"}).out, "--spp"));
}

TEST_F(CommandLine, WrongUsageIsTwoAndSaysWhatIsWrong) {
  struct Case {
    std::vector<std::string> more;
    const char* said;
  };
  const Case cases[] = {
      {{"--spp", "0"}, "from 1 to 65536"},
      {{"--spp", "-1"}, "from 1 to 65536"},
      {{"--spp", "0x10"}, "from 1 to 65536"},
      {{"--spp", "1e9"}, "from 1 to 65536"},
      {{"--spp", "99999999999999999999999"}, "from 1 to 65536"},
      {{"--spp", ""}, "--spp"},
      {{"--light-samples", "0"}, "from 1 to 4096"},
      {{"--exposure", "nan"}, "from -64 to 64"},
      {{"--threads", "-3"}, "from 0 to 1024"},
      {{"--size", "16"}, "WxH"},
      {{"--size", "0x8"}, "from 1 to 65536"},
      {{"--crop", "4x4"}, "WxH+X+Y"},
      {{"--crop", "4x4+14+0"}, "not within the image"},
      {{"--aov", "normal,colour"}, "'colour'"},
      {{"--tonemap", "filmic"}, "none|srgb"},
      {{"--filter", "sinc"}, "box|"},
      {{"--ao-distance", "0"}, "from 1e-30"},
      {{"--kernel", "magic"}, "magic"},
      {{"--simd", "MMX"}, "MMX"},
      {{"--camera", "nose"}, "'eye'"},
      {{"--frobnicate"}, "frobnicate"},
      {{"-q", "--verbose"}, "verbose"},
      {{"-o", "OUT_AGAIN"}, "twice"},
  };
  for (const Case& c : cases) {
    std::vector<std::string> more = c.more;
    for (std::string& word : more) word = word == "OUT_AGAIN" ? path("out.exr") : word;
    const Outcome outcome = render(more);
    EXPECT_EQ(outcome.code, 2) << more[0] << " " << more.back() << ": " << outcome.err;
    EXPECT_TRUE(contains(outcome.err, c.said)) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, more[0]) || contains(outcome.err, "out.exr") ||
                contains(outcome.err, "--verbose"))
        << "no flag or file is named: " << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_FALSE(exists("out.exr"));
  }
}

TEST_F(CommandLine, MoreThanTheLimitsIsSix) {
  const Outcome outcome = render({"--size", "65536x65536"});
  EXPECT_EQ(outcome.code, 6);
  EXPECT_TRUE(contains(outcome.err, "65536x65536")) << outcome.err;
  EXPECT_EQ(render({"--size", "65536x65536", "--crop", "4x4+60000+30000"}).code, 0) << "a part is small enough";
}

TEST_F(CommandLine, MissingPartsAreUsageErrors) {
  EXPECT_EQ(run({}).code, 2);
  EXPECT_EQ(run({"paint"}).code, 2);
  EXPECT_EQ(run({"render"}).code, 2);
  EXPECT_EQ(run({"render", path("scene.gltf")}).code, 2);
  EXPECT_EQ(run({"render", "-o", path("out.exr")}).code, 2);
  EXPECT_EQ(run({"info"}).code, 2);
}

TEST_F(CommandLine, OptionsMayStandAnywhere) {
  EXPECT_EQ(
      run({"render", "-o", path("a.exr"), "--spp", "2", path("scene.gltf"), "--size", "8x8", "-o", path("b.png")}).code,
      0);
  EXPECT_TRUE(exists("a.exr") && exists("b.png"));
}

TEST_F(CommandLine, BadInputIsThreeAndNamesTheFile) {
  write("broken.gltf", "{\"asset\": ");
  write("empty.glb", "");
  write("setup.json", "[1, 2");
  for (const char* name : {"absent.gltf", "broken.gltf", "empty.glb"}) {
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"render", path(name), "-o", path("out.exr")}, {"info", path(name)}}) {
      const Outcome outcome = run(arguments);
      EXPECT_EQ(outcome.code, 3) << name;
      EXPECT_TRUE(contains(outcome.err, name)) << outcome.err;
      EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << "one line: " << outcome.err;
    }
  }
  const Outcome setup = render({"--setup", path("setup.json")});
  EXPECT_EQ(setup.code, 3);
  EXPECT_TRUE(contains(setup.err, "setup.json")) << setup.err;
  EXPECT_FALSE(exists("out.exr"));
}

TEST_F(CommandLine, ControlCharactersInNamesDoNotReachTheTerminal) {
  const Outcome outcome = run({"info", path("\x1b[31mred.gltf")});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_FALSE(contains(outcome.err, "\x1b"));
}

TEST_F(CommandLine, DryRunChecksAndWritesNothing) {
  const Outcome outcome = render({"--dry-run"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(contains(outcome.out, "16x8")) << outcome.out;
  EXPECT_FALSE(exists("out.exr"));
  EXPECT_EQ(render({"--dry-run", "--camera", "nose"}).code, 2);
}

TEST_F(CommandLine, ResultsGoToStdoutAndTalkToStderr) {
  const Outcome plain = render({});
  EXPECT_EQ(plain.code, 0) << plain.err;
  EXPECT_EQ(plain.out, "");
  EXPECT_TRUE(contains(plain.err, "shadow")) << plain.err;
  const Outcome quiet = render({"--quiet", "--overwrite"});
  EXPECT_EQ(quiet.code, 0);
  EXPECT_EQ(quiet.out + quiet.err, "");
}

TEST_F(CommandLine, ProgressLinesAreWholeLines) {
  const Outcome lines = render({"--progress", "lines", "--size", "200x100"});
  EXPECT_TRUE(contains(lines.err, "100% of")) << lines.err;
  EXPECT_FALSE(contains(lines.err, "\r"));
  EXPECT_TRUE(contains(render({"--progress", "bar", "--overwrite"}).err, "\r["));
  EXPECT_FALSE(contains(render({"--progress", "none", "--overwrite"}).err, "tiles"));
}

TEST_F(CommandLine, KernelsAreListed) {
  const Outcome table = run({"kernels"});
  EXPECT_EQ(table.code, 0);
  EXPECT_TRUE(contains(table.out, "standard"));
  EXPECT_TRUE(contains(run({"kernels", "--json"}).out, "\"simd_targets\""));
}

}  // namespace
}  // namespace umbrix::app
