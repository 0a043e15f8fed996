// SPDX-License-Identifier: Apache-2.0
// One call of the system fails, for every call in turn: what cannot be overcome is told with the right code and file,
// and the files are as they were or complete.
#include "fault_test.h"

namespace umbrix::app {
namespace {

class Calls : public FaultTest {
 protected:
  /// Fails the call's 1st, 2nd, ... use until one run has none left to fail; in a short test the 1st, 3rd, 9th, ...
  /// `check` looks at each outcome.
  template <class Check>
  void fail_each(const std::string& call, const std::string& how, FaultRow& row, Check&& check) {
    for (int n = 1;; n = fault_runs(0, 1) > 0 ? n + 1 : 3 * n) {
      for (const char* name : {"out.exr", "out.png"}) write(name, "precious");
      const Outcome outcome = wait(start_command(with_environment(
          {"LD_PRELOAD=" UMBRIX_CALL_FAULTS, "UMBRIX_FAIL_IN=" + folder_.string(),
           "UMBRIX_FAIL=" + call + ":" + std::to_string(n) + ":" + how, "UMBRIX_FAIL_MARK=" + path("failed")},
          program(render_arguments()))));
      if (!exists("failed")) {
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_GT(n, 1) << "the program never calls " << call;
        return;
      }
      std::filesystem::remove(path("failed"));
      const bool good = temporaries().empty() && is_whole("out.exr") && is_whole("out.png") && check(outcome);
      EXPECT_TRUE(good) << call << " " << n << " " << how << ": " << outcome.code << " " << outcome.err
                        << testing::PrintToString(files());
      row.add(good);
    }
  }

  bool is_complete(const Outcome& outcome) { return outcome.code == 0 && is_new("out.exr") && is_new("out.png"); }

  static bool names(const Outcome& outcome, const std::string& file) {
    return outcome.err.find(file) != std::string::npos && outcome.err.find('\n') == outcome.err.size() - 1;
  }
};

TEST_F(Calls, FailingWrites) {
  make_expected();
  FaultRow row("a write, fsync, close, open or rename fails (ENOSPC, EIO)");
  const auto is_told = [&](const Outcome& outcome) { return outcome.code == 4 && names(outcome, "out."); };
  // Opening and closing are also what reading does, and what syncs a folder: these may say so, or be overcome.
  const auto is_told_or_done = [&](const Outcome& outcome) {
    return is_complete(outcome) || ((outcome.code == 4 || outcome.code == 3) && names(outcome, path("")));
  };
  fail_each("pwrite", "ENOSPC", row, is_told);
  fail_each("pwrite", "EIO", row, is_told);
  fail_each("rename", "EIO", row, is_told);
  fail_each("fsync", "EIO", row, is_told_or_done);
  fail_each("close", "EIO", row, is_told_or_done);
  fail_each("open", "ENOSPC", row, is_told_or_done);
}

TEST_F(Calls, InterruptedAndShortCallsAreContinued) {
  make_expected();
  FaultRow row("a call is interrupted (EINTR) or short");
  const auto is_done = [&](const Outcome& outcome) { return is_complete(outcome); };
  fail_each("pwrite", "EINTR", row, is_done);
  fail_each("pwrite", "short", row, is_done);
  for (const char* call : {"fsync", "close", "rename", "open", "read"}) fail_each(call, "EINTR", row, is_done);
  fail_each("read", "short", row, is_done);
}

TEST_F(Calls, FailingReadsAreBadInput) {
  make_expected();
  FaultRow row("a read fails (EIO)");
  fail_each("read", "EIO", row, [&](const Outcome& outcome) {
    return outcome.code == 3 && names(outcome, "scene.") && read("out.exr") == "precious";
  });
}

}  // namespace
}  // namespace umbrix::app
