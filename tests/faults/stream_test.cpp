// SPDX-License-Identifier: Apache-2.0
// Standard output that is closed, full, or a pipe that nobody reads.
#include <unistd.h>

#include <cstdio>

#include "fault_test.h"

namespace umbrix::app {
namespace {

class Streams : public FaultTest {
 protected:
  /// What prints: each on standard output.
  std::vector<std::vector<std::string>> printing() const {
    return {
        {"info", path("scene.gltf")},
        {"info", path("scene.gltf"), "--json"},
        {"kernels"},
        {"kernels", "--json"},
        {"--help"},
        {"--version"},
        {"render", "--help"},
        {"render", path("scene.gltf"), "-o", path("out.exr"), "--dry-run"},
        {"render", path("scene.gltf"), "-q", "-o", path("out.exr"), "--size", "16x8", "--overwrite", "--stats", "-"}};
  }

  Outcome run_in_shell(const std::string& script, const std::vector<std::string>& arguments) {
    std::vector<std::string> words = {"/bin/sh", "-c", script, "sh"};
    for (const std::string& word : program(arguments)) words.push_back(word);
    return wait(start_command(words));
  }
};

TEST_F(Streams, APipeThatNobodyReadsEndsQuietly) {
  FaultRow row("standard output is a pipe that nobody reads");
  for (const auto& arguments : printing()) {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    close(ends[0]);
    const pid_t process = start_command(program(arguments), ends[1]);
    close(ends[1]);
    const Outcome outcome = wait(process);
    row.add(outcome.code == 141 && outcome.err.empty());
    EXPECT_EQ(outcome.code, 141) << arguments[0];
    EXPECT_EQ(outcome.err, "");
  }
}

TEST_F(Streams, AFullOneIsFour) {
  FaultRow row("standard output is /dev/full");
  for (const auto& arguments : printing()) {
    const Outcome outcome = run_in_shell("exec \"$@\" > /dev/full", arguments);
    row.add(outcome.code == 4);
    EXPECT_EQ(outcome.code, 4) << arguments[0];
    EXPECT_EQ(outcome.err, "umbrix: standard output: No space left on device\n");
  }
}

TEST_F(Streams, AClosedOneIsFour) {
  FaultRow row("standard output is closed");
  for (const auto& arguments : printing()) {
    const Outcome outcome = run_in_shell("exec \"$@\" >&-", arguments);
    row.add(outcome.code == 4);
    EXPECT_EQ(outcome.code, 4) << arguments[0];
    EXPECT_NE(outcome.err.find("standard output"), std::string::npos) << outcome.err;
  }
}

TEST_F(Streams, ARenderNeedsNone) {
  make_expected();
  FaultRow row("a render with closed or full standard streams");
  for (const char* script : {"exec \"$@\" <&- >&- 2>&-", "exec \"$@\" 2> /dev/full", "exec \"$@\" > /dev/full"}) {
    std::vector<std::string> arguments = render_arguments();
    arguments.erase(arguments.begin() + 2);  // not quiet
    const Outcome outcome = run_in_shell(script, arguments);
    const bool good = outcome.code == 0 && is_new("out.exr") && is_new("out.png");
    row.add(good);
    EXPECT_TRUE(good) << script << " " << outcome.code;
  }
}

}  // namespace
}  // namespace umbrix::app
