// SPDX-License-Identifier: Apache-2.0
// SIGINT and SIGTERM at any time, in every phase: the right code, at once, with nothing half-written.
#include <algorithm>
#include <chrono>
#include <csignal>

#include "fault_test.h"

namespace umbrix::app {
namespace {

class Signal : public FaultTest {
 protected:
  /// Runs the command and interrupts it after at most so many seconds. It may also be done by then.
  void interrupt(const std::vector<std::string>& arguments, double most_seconds, int runs, FaultRow& row) {
    for (int i = 0; i < runs; ++i) {
      for (const char* name : {"out.exr", "out.png"}) write(name, "precious");
      const int number = i % 2 == 0 ? SIGINT : SIGTERM;
      const pid_t process = start(arguments);
      sleep_for_some(most_seconds);
      const auto sent = std::chrono::steady_clock::now();
      kill(process, number);
      const Outcome outcome = wait(process);
      const double latency = std::chrono::duration<double>(std::chrono::steady_clock::now() - sent).count();
      const bool good = (outcome.code == 128 + number || outcome.code == 0) && temporaries().empty() &&
                        is_whole("out.exr") && is_whole("out.png");
      EXPECT_TRUE(good) << outcome.code << " " << outcome.err << testing::PrintToString(files());
      row.add(good);
      if (outcome.code != 0) row.add_latency(latency);
    }
  }
};

TEST_F(Signal, AtAnyTime) {
  make_expected();
  FaultRow row("SIGINT and SIGTERM at a random time of a render");
  interrupt(render_arguments(), seconds_, fault_runs(8, 200), row);
}

TEST_F(Signal, WhileALargeTreeIsBuilt) {
  const std::string scene = shared_scene("embree_tree");
  if (scene.empty()) GTEST_SKIP() << "no shared scenes";
  make_expected();
  FaultRow row("SIGINT and SIGTERM while a tree over 2.4 million triangles is built");
  std::vector<std::string> arguments = render_arguments();
  arguments[1] = scene;
  arguments.insert(arguments.end(), {"--instances", "flatten", "--kernel", "standard"});
  interrupt(arguments, 4, fault_runs(1, 25), row);
}

TEST_F(Signal, WhileManySamplesAreTaken) {
  make_expected();
  FaultRow row("SIGINT and SIGTERM in a render of 60000 samples a pixel");
  std::vector<std::string> arguments = render_arguments();
  arguments.insert(arguments.end(), {"--spp", "60000"});
  interrupt(arguments, 1, fault_runs(1, 50), row);
}

TEST_F(Signal, WhileALargeImageIsWritten) {
  make_expected();
  FaultRow row("SIGINT and SIGTERM while an image of 64 megapixels is written");
  // Three quarters of its time.
  std::vector<std::string> arguments = render_arguments();
  *std::find(arguments.begin(), arguments.end(), "400x200") = "8000x8000";
  interrupt(arguments, 12, fault_runs(0, 12), row);
}

TEST_F(Signal, WhatIsIgnoredStaysIgnored) {
  const Outcome outcome = wait(start_command({"/bin/sh", "-c", "trap '' INT; \"$@\" & kill -INT $!; wait $!", "sh",
                                              UMBRIX_PROGRAM, "info", path("scene.gltf")}));
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

}  // namespace
}  // namespace umbrix::app
