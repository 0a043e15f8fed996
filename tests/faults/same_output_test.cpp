// SPDX-License-Identifier: Apache-2.0
// Many processes that write one file at the same time.
#include "fault_test.h"

namespace umbrix::app {
namespace {

class SameOutput : public FaultTest {
 protected:
  std::vector<Outcome> run_together(int count, const std::vector<std::string>& more) {
    std::vector<pid_t> processes;
    std::vector<Outcome> outcomes;
    for (int i = 0; i < count; ++i) {
      std::vector<std::string> arguments = {
          "render", path("scene.gltf"),   "-q", "-o", path("same.exr"), "--size", "320x160", "--spp", "2", "-j", "1",
          "--seed", std::to_string(i % 2)};
      arguments.insert(arguments.end(), more.begin(), more.end());
      processes.push_back(start(arguments));
    }
    for (const pid_t process : processes) outcomes.push_back(wait(process));
    return outcomes;
  }
};

TEST_F(SameOutput, IsOneCompleteImage) {
  const int count = fault_runs(6, 50);
  FaultRow row(std::to_string(count) + " processes write one file");
  std::vector<std::string> images;
  for (const char* seed : {"0", "1"}) {
    ASSERT_EQ(run({"render", path("scene.gltf"), "-q", "-o", path("one.exr"), "--overwrite", "--size", "320x160",
                   "--spp", "2", "--seed", seed})
                  .code,
              0);
    images.push_back(read("one.exr"));
  }
  ASSERT_NE(images[0], images[1]);
  for (const Outcome& outcome : run_together(count, {"--overwrite"})) {
    EXPECT_EQ(outcome.code, 0);
    row.add(outcome.code == 0);
  }
  const std::string same = read("same.exr");
  EXPECT_TRUE(same == images[0] || same == images[1]);
  EXPECT_EQ(temporaries(), std::vector<std::string>());
}

TEST_F(SameOutput, WithoutOverwriteOneSucceeds) {
  const int count = fault_runs(4, 50);
  FaultRow row(std::to_string(count) + " processes write one file, none may overwrite it");
  int written = 0;
  for (const Outcome& outcome : run_together(count, {})) {
    row.add(outcome.code == 0 || outcome.code == 4);
    EXPECT_TRUE(outcome.code == 0 || outcome.code == 4) << outcome.code;
    written += outcome.code == 0;
  }
  EXPECT_EQ(written, 1);
  EXPECT_EQ(temporaries(), std::vector<std::string>());
}

}  // namespace
}  // namespace umbrix::app
