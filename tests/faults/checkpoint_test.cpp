// SPDX-License-Identifier: Apache-2.0
// A render that is interrupted or killed again and again, with checkpoints, ends in the bytes of one that was not.
#include <algorithm>
#include <chrono>
#include <csignal>

#include "fault_test.h"

namespace umbrix::app {
namespace {

class CheckpointFault : public FaultTest {
 protected:
  /// Starts the render until it has ended by itself, a signal at a random time each but the last; how long the signals
  /// took goes to the row.
  bool render_in_pieces(const std::vector<int>& signals, FaultRow& row) {
    for (const int number : signals) {
      const pid_t process = start(arguments_);
      sleep_for_some(seconds_);
      const auto sent = std::chrono::steady_clock::now();
      kill(process, number);
      const Outcome outcome = wait(process);
      if (outcome.code == 0) return true;
      row.add_latency(std::chrono::duration<double>(std::chrono::steady_clock::now() - sent).count());
      if (outcome.code != 128 + number || !is_whole("out.exr") || !is_whole("out.png")) return false;
    }
    return wait(start(arguments_)).code == 0;
  }

  std::vector<std::string> arguments_;
};

TEST_F(CheckpointFault, TheResultIsThatOfOneRun) {
  make_expected();
  arguments_ = render_arguments();
  arguments_.erase(std::remove(arguments_.begin(), arguments_.end(), "--overwrite"), arguments_.end());
  arguments_.insert(arguments_.end(), {"--resume", "--checkpoint", "1s"});
  for (const auto& [numbers, kind] : {std::pair(std::vector<int>{SIGTERM, SIGINT, SIGTERM},
                                                "SIGINT and SIGTERM, with checkpoints, until a render ends"),
                                      std::pair(std::vector<int>{SIGKILL, SIGUSR1, SIGKILL},
                                                "SIGKILL and SIGUSR1, with checkpoints, until a render ends")}) {
    FaultRow row(kind);
    for (int i = 0; i < fault_runs(2, 100); ++i) {
      for (const char* name : {"out.exr", "out.png"}) write(name, "precious");
      const bool ended = render_in_pieces(numbers, row);
      age_temporaries();
      const bool good = ended && is_new("out.exr") && is_new("out.png") && !exists("out.exr.part");
      EXPECT_TRUE(good) << testing::PrintToString(files());
      row.add(good);
    }
  }
}

}  // namespace
}  // namespace umbrix::app
