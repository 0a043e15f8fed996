// SPDX-License-Identifier: Apache-2.0
#include "progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "message.h"
#include "openjd_lines.h"

namespace umbrix::app {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::string clock_text(double seconds) {
  const long whole = std::lround(seconds);
  return whole < 3600 ? fmt::format("{}:{:02}", whole / 60, whole % 60)
                      : fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

ProgressStyle resolve(ProgressStyle style) {
  if (style != ProgressStyle::automatic) return style;
  return isatty(STDERR_FILENO) ? ProgressStyle::bar : ProgressStyle::lines;
}

}  // namespace

Progress::Progress(ProgressStyle style, std::size_t frames)
    : style_(resolve(style)), frames_(frames), start_(Clock::now()), drawn_(start_) {}

void Progress::update(std::size_t done, std::size_t total) {
  const double of_frame = static_cast<double>(done) / static_cast<double>(total);
  const double share = (static_cast<double>(frames_done_) + of_frame) / static_cast<double>(frames_);
  if (style_ == ProgressStyle::bar && (share == 1 || seconds_since(drawn_) > 0.1)) {
    drawn_ = Clock::now();
    draw_bar(share);
  }
  if (style_ == ProgressStyle::openjd) tell_openjd(share);
  // One line for each tenth, or for each frame: few enough for a log, often enough for a farm.
  const int tenths = static_cast<int>(share * 10);
  if (style_ == ProgressStyle::lines && frames_ == 1 && tenths > tenths_) {
    tenths_ = tenths;
    say(fmt::format("umbrix: {:3}% of {} tiles, {} left", tenths * 10, total, clock_text(seconds_left(share))));
  }
}

void Progress::tell_openjd(double share) {
  // A line for each hundredth: few enough for a log.
  const int percent = static_cast<int>(share * 100);
  if (percent <= percent_) return;
  percent_ = percent;
  say_openjd_progress(share * 100);
}

void Progress::frame_done(std::optional<int> number) {
  ++frames_done_;
  if (style_ == ProgressStyle::openjd) {
    say_openjd_status(fmt::format("{} of {} frames done", frames_done_, frames_));
    tell_openjd(static_cast<double>(frames_done_) / static_cast<double>(frames_));
  }
  if (style_ != ProgressStyle::lines || frames_ == 1 || !number) return;
  const double share = static_cast<double>(frames_done_) / static_cast<double>(frames_);
  say(fmt::format("umbrix: frame {} done, {} of {}, {} left", *number, frames_done_, frames_,
                  clock_text(seconds_left(share))));
}

void Progress::finish() {
  if (bar_shown_) std::fputc('\n', stderr);
  bar_shown_ = false;
}

double Progress::seconds_left(double share) const { return seconds_since(start_) * (1 - share) / share; }

void Progress::draw_bar(double share) {
  constexpr int kWidth = 40;
  const auto filled = static_cast<std::size_t>(share * kWidth);
  const std::string bar = std::string(filled, '#') + std::string(kWidth - filled, '.');
  const std::string frame = frames_ > 1 ? fmt::format("frame {} of {}, ", frames_done_ + 1, frames_) : "";
  std::fputs(
      fmt::format("\r[{}] {:3.0f}% {}{} left ", bar, share * 100, frame, clock_text(seconds_left(share))).c_str(),
      stderr);
  std::fflush(stderr);
  bar_shown_ = true;
}

}  // namespace umbrix::app
