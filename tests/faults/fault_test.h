// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>
#include <string>
#include <vector>

#include "../cli/program.h"

namespace umbrix::app {

/// A few runs by default, and UMBRIX_FAULT_RUNS of 200 where scripts/faults.sh sets it.
int fault_runs(int few, int many);

/// One kind of fault: what happened, printed as a row of the table of scripts/faults.sh.
class FaultRow {
 public:
  explicit FaultRow(std::string kind) : kind_(std::move(kind)) {}
  ~FaultRow();
  FaultRow(const FaultRow&) = delete;
  FaultRow& operator=(const FaultRow&) = delete;

  /// One run is over. A failure is told where it is seen; here it is counted.
  void add(bool good) {
    ++runs_;
    failures_ += good ? 0 : 1;
  }
  void add_latency(double seconds) { latencies_.push_back(seconds); }
  /// "p50" is 0.5.
  double percentile(double share) const;
  void remark(std::string text) { remark_ = std::move(text); }

 private:
  std::string kind_, remark_;
  int runs_ = 0, failures_ = 0;
  std::vector<double> latencies_;
};

/// The program in a folder with a small scene, out.exr and out.png; random times come from a seed that is printed.
class FaultTest : public ProgramTest {
 protected:
  void SetUp() override;

  /// A render of the scene to out.exr and out.png, large enough that writing takes a good share of it.
  std::vector<std::string> render_arguments() const;

  /// Renders once and keeps the bytes; then puts "precious" in the place of the files.
  void make_expected();
  /// Is the file complete, or still as it was?
  bool is_whole(const std::string& name) const;
  bool is_new(const std::string& name) const;

  std::vector<std::string> temporaries() const;
  /// Makes what was left look as if it had been left long ago.
  void age_temporaries() const;

  void sleep_for_some(double most_seconds);

  double seconds_ = 0;  ///< of a whole render
  std::string exr_, png_;
  std::mt19937 random_;
};

/// A large scene of the team's folder (UMBRIX_SCENES_DIR), or "" if it is not there.
std::string shared_scene(const std::string& name);

/// Variables of the environment for the program alone.
std::vector<std::string> with_environment(const std::vector<std::string>& variables,
                                          const std::vector<std::string>& command);

}  // namespace umbrix::app
