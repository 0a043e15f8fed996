// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace umbrix::app {

struct Outcome {
  int code = -1;  ///< exit code, or 128 + the signal that ended it
  std::string out;
  std::string err;
  double peak_megabytes = 0;  ///< of memory held
};

/// A test with an empty folder of its own, removed at the end, in which `umbrix` is run.
class ProgramTest : public testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;

  /// Runs the built program to its end.
  Outcome run(const std::vector<std::string>& arguments);

  /// Starts it; `wait` gives the outcome.
  pid_t start(const std::vector<std::string>& arguments);
  /// Starts any command, such as `program(...)` in a shell; its standard output may be a file of the caller.
  pid_t start_command(std::vector<std::string> words, int standard_output = -1);
  Outcome wait(pid_t process);

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void write(const std::string& name, const std::string& text) const;
  std::string read(const std::string& name) const;
  bool exists(const std::string& name) const { return std::filesystem::exists(folder_ / name); }

  /// The words of a command that runs the program.
  static std::vector<std::string> program(const std::vector<std::string>& arguments);

  /// The names in the folder, sorted.
  std::vector<std::string> files() const;

  /// Writes "scene.gltf": a square above a larger one, a camera named "eye" and a point light named "lamp".
  void write_scene() const;

  std::filesystem::path folder_;
};

}  // namespace umbrix::app
