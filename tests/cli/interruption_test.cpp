// SPDX-License-Identifier: Apache-2.0
// SIGINT and SIGTERM end a render soon, with the code that shells expect and nothing half-written.
#include <csignal>
#include <fstream>
#include <thread>

#include "program.h"

namespace umbrix::app {
namespace {

class Interruption : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write_scene();
    before_ = files();
  }

  /// Starts a render that would take hours, and comes back when it has begun to render.
  pid_t start_endless() {
    const pid_t process = start({"render", path("scene.gltf"), "-o", path("out.exr"), "-o", path("out.png"), "--size",
                                 "20000x20", "--spp", "60000", "--progress", "none", "--stats", path("stats.json")});
    // Progress says nothing for a long time; that the signals are caught can be read from the system.
    while (!catches_signals(process)) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    return process;
  }

  static bool catches_signals(pid_t process) {
    std::ifstream status("/proc/" + std::to_string(process) + "/status");
    for (std::string line; std::getline(status, line);) {
      if (line.rfind("SigCgt:", 0) == 0) return std::stoull(line.substr(7), nullptr, 16) >> (SIGINT - 1) & 1;
    }
    return false;
  }

  std::vector<std::string> before_;
};

TEST_F(Interruption, InterruptIs130) {
  const pid_t process = start_endless();
  kill(process, SIGINT);
  const Outcome outcome = wait(process);
  EXPECT_EQ(outcome.code, 130);
  EXPECT_NE(outcome.err.find("interrupted"), std::string::npos) << outcome.err;
  EXPECT_EQ(files(), before_);
}

TEST_F(Interruption, TerminateIs143) {
  const pid_t process = start_endless();
  kill(process, SIGTERM);
  EXPECT_EQ(wait(process).code, 143);
  EXPECT_EQ(files(), before_);
}

TEST_F(Interruption, ExistingFileSurvives) {
  write("out.exr", "precious");
  const pid_t process = start({"render", path("scene.gltf"), "-o", path("out.exr"), "--overwrite", "--size", "20000x20",
                               "--spp", "60000", "--progress", "none"});
  while (!catches_signals(process)) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  kill(process, SIGTERM);
  EXPECT_EQ(wait(process).code, 143);
  EXPECT_EQ(read("out.exr"), "precious");
}

}  // namespace
}  // namespace umbrix::app
