// SPDX-License-Identifier: Apache-2.0
// --log-file keeps what is said, line by line, with times.
#include <ctime>
#include <regex>
#include <sstream>

#include "program.h"

namespace umbrix::app {
namespace {

class LogFile : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write_scene();
  }

  Outcome render(std::vector<std::string> more = {}) {
    std::vector<std::string> arguments = {"render", path("scene.gltf"), "-o",           path("out.exr"), "--size",
                                          "16x8",   "--log-file",       path("run.log")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }

  /// The log without its times, each of which must be within the test.
  std::string said() {
    std::istringstream log(read("run.log"));
    std::string text, line;
    const std::regex form("(\\d{4}-\\d\\d-\\d\\dT\\d\\d:\\d\\d:\\d\\dZ) (.*)");
    std::string before = start_;
    while (std::getline(log, line)) {
      std::smatch parts;
      if (!std::regex_match(line, parts, form)) {
        ADD_FAILURE() << line;
        continue;
      }
      EXPECT_LE(before, parts[1].str());
      EXPECT_LE(parts[1].str(), now());
      before = parts[1].str();
      text += parts[2].str() + '\n';
    }
    return text;
  }

  /// By the C library.
  static std::string now() {
    const std::time_t seconds = std::time(nullptr);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&seconds));
    return text;
  }

  std::string start_ = now();
};

TEST_F(LogFile, HasWhatIsSaid) {
  const Outcome outcome = render({"--frames", "1", "--progress", "lines", "-v"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("100%"), std::string::npos) << outcome.err;
  EXPECT_EQ(said(), outcome.err);
}

TEST_F(LogFile, KeepsEarlierRunsAndErrors) {
  const Outcome first = render(), refused = render();
  EXPECT_EQ(first.code, 0) << first.err;
  EXPECT_EQ(refused.code, 4);
  write("scene.gltf", "{}");
  const Outcome bad = render({"--overwrite", "-q"});
  EXPECT_EQ(bad.code, 3);
  const Outcome merged = run({"merge", path("none.exr"), "-o", path("frame.exr"), "--log-file", path("run.log")});
  EXPECT_NE(merged.code, 0);
  EXPECT_EQ(said(), first.err + refused.err + bad.err + merged.err);
}

TEST_F(LogFile, HasTheLastWordsOfARunThatIsEnded) {
  const Outcome ended = run({"render", path("scene.gltf"), "-o", path("out.exr"), "--size", "512x512", "--spp", "65536",
                             "--time-limit", "1", "--log-file", path("run.log")});
  EXPECT_EQ(ended.code, 5);
  EXPECT_NE(said().find("the time limit of 1 s was reached"), std::string::npos) << said();
}

TEST_F(LogFile, ThatCannotBeOpenedIsFour) {
  const Outcome outcome =
      run({"render", path("scene.gltf"), "-o", path("out.exr"), "--log-file", path("none/run.log")});
  EXPECT_EQ(outcome.code, 4);
  EXPECT_EQ(outcome.err,
            "umbrix: " + path("none/run.log") + ": cannot be opened: No such file or directory (--log-file)\n");
  EXPECT_FALSE(exists("out.exr"));
}

}  // namespace
}  // namespace umbrix::app
