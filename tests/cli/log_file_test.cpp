// SPDX-License-Identifier: Apache-2.0
// --log-file keeps what is said, line by line, with times.
#include <algorithm>
#include <ctime>
#include <sstream>
#include <string_view>

#include "program.h"

namespace umbrix::app {
namespace {

/// 0 is any digit.
constexpr std::string_view kTime = "0000-00-00T00:00:00Z ";

bool starts_with_time(const std::string& line) {
  return line.size() >= kTime.size() && std::equal(kTime.begin(), kTime.end(), line.begin(), [](char form, char c) {
           return form == '0' ? c >= '0' && c <= '9' : c == form;
         });
}

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
    std::string before = start_;
    while (std::getline(log, line)) {
      if (!starts_with_time(line)) {
        ADD_FAILURE() << line;
        continue;
      }
      const std::string time = line.substr(0, kTime.size() - 1);
      EXPECT_LE(before, time);
      EXPECT_LE(time, now());
      before = time;
      text += line.substr(kTime.size()) + '\n';
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
