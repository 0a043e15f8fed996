// SPDX-License-Identifier: Apache-2.0
// Memory that is limited, runs out, or should not grow.
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <thread>

#include "fault_test.h"

namespace umbrix::app {
namespace {

class Memory : public FaultTest {
 protected:
  /// `--memory-limit` or a shell's limit: either everything is right, or it is code 6 and one line.
  bool is_right_or_six(const Outcome& outcome) {
    const bool one_line = !outcome.err.empty() && outcome.err.find('\n') == outcome.err.size() - 1;
    const bool good =
        temporaries().empty() && (outcome.code == 0 ? is_new("out.exr") && is_new("out.png")
                                                    : outcome.code == 6 && one_line && is_whole("out.exr"));
    EXPECT_TRUE(good) << outcome.code << " " << outcome.err;
    return good;
  }

  static double resident_megabytes(pid_t process) {
    std::ifstream file("/proc/" + std::to_string(process) + "/statm");
    double all = 0, resident = 0;
    file >> all >> resident;
    return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20);
  }
};

TEST_F(Memory, WhatCannotFitIsRefusedAndNamed) {
  std::vector<std::string> arguments = render_arguments();
  *std::find(arguments.begin(), arguments.end(), "400x200") = "8000x8000";
  arguments.insert(arguments.end(), {"--memory-limit", "1G"});
  const Outcome image = run(arguments);
  EXPECT_EQ(image.code, 6);
  EXPECT_NE(image.err.find("image of 8000x8000"), std::string::npos) << image.err;
  EXPECT_NE(image.err.find("1024 MB"), std::string::npos) << image.err;

  const Outcome held = run({"info", path("scene.gltf"), "--memory-limit", "1M"});
  EXPECT_EQ(held.code, 6);
  EXPECT_NE(held.err.find("memory limit of 1 MB"), std::string::npos) << held.err;
  EXPECT_EQ(run({"info", path("scene.gltf"), "--memory-limit", "0"}).code, 0);
  for (const char* size : {"", "2X", "G", "-1", "1e99T", "nan"})
    EXPECT_EQ(run({"info", path("scene.gltf"), "--memory-limit", size}).code, 2) << size;
}

TEST_F(Memory, LimitOfAnySizeOnALargeScene) {
  const std::string scene = shared_scene("victorian_house");
  const int count = fault_runs(0, 20);
  if (scene.empty() || count == 0) GTEST_SKIP() << "no shared scenes, or a short run";
  make_expected();
  std::vector<std::string> arguments = render_arguments();
  arguments[1] = scene;
  ASSERT_EQ(run(arguments).code, 0);
  exr_ = read("out.exr");
  png_ = read("out.png");
  FaultRow row("--memory-limit from 40 MB to 1 GB, 1 million triangles");
  int refused = 0;
  double most_above = 0;
  for (int i = 0; i < count; ++i) {
    for (const char* name : {"out.exr", "out.png"}) write(name, "precious");
    const double megabytes = 40 * std::pow(25.0, i / std::max(1.0, count - 1.0));
    std::vector<std::string> limited = arguments;
    limited.insert(limited.end(), {"--memory-limit", std::to_string(static_cast<long>(megabytes)) + "M"});
    const Outcome outcome = run(limited);
    SCOPED_TRACE(megabytes);
    row.add(is_right_or_six(outcome));
    refused += outcome.code == 6 ? 1 : 0;
    most_above = std::max(most_above, outcome.peak_megabytes - megabytes);
  }
  char text[96];
  std::snprintf(text, sizeof text, "%d refused with code 6; at most %.0f MB above the limit", refused, most_above);
  row.remark(text);
}

/// What --dry-run foresees against what is held at the peak.
TEST_F(Memory, IsForeseen) {
  if (fault_runs(0, 1) == 0) GTEST_SKIP() << "a short run";
  FaultRow row("memory foreseen / held at the peak");
  std::string ratios;
  for (const char* name : {"classroom", "sponza_crytek", "bedroom", "conference", "victorian_house"}) {
    if (shared_scene(name).empty()) continue;
    const std::vector<std::string> arguments = {"render", shared_scene(name), "-q",
                                                "-o",     path("out.exr"),    "--overwrite"};
    std::vector<std::string> dry = arguments;
    dry.push_back("--dry-run");
    const std::string said = run(dry).out;
    const double foreseen = std::atof(said.c_str() + said.find("about ") + 6);
    const Outcome outcome = run(arguments);
    const double ratio = foreseen / outcome.peak_megabytes;
    char text[64];
    std::snprintf(text, sizeof text, "%s%s %.0f/%.0f MB", ratios.empty() ? "" : ", ", name, foreseen,
                  outcome.peak_megabytes);
    ratios += text;
    const bool good = outcome.code == 0 && ratio > 0.9 && ratio < 1.25;
    EXPECT_TRUE(good) << text;
    row.add(good);
  }
  row.remark(ratios);
}

TEST_F(Memory, AddressSpaceOfAnySize) {
  make_expected();
  std::vector<std::string> arguments = render_arguments();
  const std::string scene = shared_scene("victorian_house");
  const bool all = fault_runs(0, 200) > 0 && !scene.empty();
  if (all) {
    arguments[1] = scene;
    ASSERT_EQ(run(arguments).code, 0);
    exr_ = read("out.exr");
    png_ = read("out.png");
  }
  FaultRow row(all ? "ulimit -v from 64 MB to 4 GB, 1 million triangles" : "ulimit -v from 64 MB to 4 GB");
  int not_started = 0, refused = 0;
  for (int i = 0, count = fault_runs(5, 64); i < count; ++i) {
    for (const char* name : {"out.exr", "out.png"}) write(name, "precious");
    const double megabytes = 64 * std::pow(64.0, i / std::max(1.0, count - 1.0));
    std::vector<std::string> words = {
        "/bin/sh", "-c",
        "ulimit -c 0; ulimit -v " + std::to_string(static_cast<long>(megabytes * 1024)) + "; exec \"$@\"", "sh"};
    for (const std::string& word : program(arguments)) words.push_back(word);
    const Outcome outcome = wait(start_command(words));
    // Where the libraries find no room to begin with, even this fails before the program's main.
    std::vector<std::string> start = {words.begin(), words.begin() + 5};
    start.push_back("--version");
    const int started = wait(start_command(start)).code;
    const bool loads = started == 0 || started == 6;
    not_started += loads ? 0 : 1;
    refused += outcome.code == 6 ? 1 : 0;
    SCOPED_TRACE(megabytes);
    row.add(!loads || is_right_or_six(outcome));
  }
  row.remark(std::to_string(refused) + " refused with code 6; " + std::to_string(not_started) +
             " too small for the libraries to start");
}

TEST_F(Memory, DoesNotGrowFromFrameToFrame) {
  const int frames = fault_runs(40, 1000);
  FaultRow row(std::to_string(frames) + " frames in one process");
  const pid_t process = start({"render", path("scene.gltf"), "-q", "-o", path("out.####.png"), "--frames",
                               "1-" + std::to_string(frames), "--size", "256x128", "-j", "2"});
  // Not to the very end: what ends the process loads more of its libraries.
  const auto file_of = [](int frame) {
    char name[32];
    std::snprintf(name, sizeof name, "out.%04d.png", frame);
    return std::string(name);
  };
  double at_first = 0, at_last = 0;
  for (double now = resident_megabytes(process); now > 0; now = resident_megabytes(process)) {
    if (exists(file_of(frames))) break;
    if (exists(file_of(frames / 4))) at_last = now;
    if (at_first == 0) at_first = at_last;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(wait(process).code, 0);
  const bool good = at_first > 0 && at_last <= 1.01 * at_first;
  EXPECT_TRUE(good) << at_first << " MB, then " << at_last;
  row.add(good);
  char text[64];
  std::snprintf(text, sizeof text, "%.2f MB, then %.2f MB", at_first, at_last);
  row.remark(text);
}

}  // namespace
}  // namespace umbrix::app
