// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>

namespace umbrix::app {

enum class ProgressStyle {
  automatic,  ///< a bar on a terminal, else lines
  bar,
  lines,
  none,
};

/// Shows on stderr how far rendering is and how long it will take.
class Progress {
 public:
  explicit Progress(ProgressStyle style);

  /// `done` of `total` tiles are complete.
  void update(std::size_t done, std::size_t total);

  /// Leaves the bar's line, if there is one.
  void finish();

 private:
  void draw_bar(double share, double seconds_left);

  ProgressStyle style_;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point drawn_;
  int tenths_ = 0;
  bool bar_shown_ = false;
};

}  // namespace umbrix::app
