// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>

namespace umbrix::app {

enum class ProgressStyle {
  automatic,  ///< a bar on a terminal, else lines
  bar,
  lines,
  none,
  openjd,  ///< the lines of Open Job Description's farms, on stdout
};

/// Shows, on stderr unless the style says otherwise, how far rendering is and how long it will take.
class Progress {
 public:
  /// Of a run of `frames` frames.
  Progress(ProgressStyle style, std::size_t frames);

  /// `done` of `total` tiles of a frame are complete.
  void update(std::size_t done, std::size_t total);

  /// A frame is complete, its files included.
  void frame_done(std::optional<int> number);

  /// Leaves the bar's line, if there is one.
  void finish();

 private:
  double seconds_left(double share) const;
  void draw_bar(double share);
  void tell_openjd(double share);

  ProgressStyle style_;
  std::size_t frames_;
  std::size_t frames_done_ = 0;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point drawn_;
  int tenths_ = 0;
  int percent_ = -1;
  bool bar_shown_ = false;
};

}  // namespace umbrix::app
