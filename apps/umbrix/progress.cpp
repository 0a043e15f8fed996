// SPDX-License-Identifier: Apache-2.0
#include "progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <string>

#include "message.h"

namespace umbrix::app {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::string clock_text(double seconds) {
  const auto whole = static_cast<long>(seconds + 0.5);
  return whole < 3600 ? fmt::format("{}:{:02}", whole / 60, whole % 60)
                      : fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

ProgressStyle resolve(ProgressStyle style) {
  if (style != ProgressStyle::automatic) return style;
  return isatty(STDERR_FILENO) ? ProgressStyle::bar : ProgressStyle::lines;
}

}  // namespace

Progress::Progress(ProgressStyle style) : style_(resolve(style)), start_(Clock::now()), drawn_(start_) {}

void Progress::update(std::size_t done, std::size_t total) {
  const double share = static_cast<double>(done) / static_cast<double>(total);
  const double seconds_left = seconds_since(start_) * (1 - share) / share;
  if (style_ == ProgressStyle::bar && (done == total || seconds_since(drawn_) > 0.1)) {
    drawn_ = Clock::now();
    draw_bar(share, seconds_left);
  }
  // One line for each tenth: few enough for a log, often enough for a farm.
  const int tenths = static_cast<int>(share * 10);
  if (style_ == ProgressStyle::lines && tenths > tenths_) {
    tenths_ = tenths;
    say(fmt::format("umbrix: {:3}% of {} tiles, {} left", tenths * 10, total, clock_text(seconds_left)));
  }
}

void Progress::finish() {
  if (bar_shown_) std::fputc('\n', stderr);
  bar_shown_ = false;
}

void Progress::draw_bar(double share, double seconds_left) {
  constexpr int kWidth = 40;
  const auto filled = static_cast<std::size_t>(share * kWidth);
  const std::string bar = std::string(filled, '#') + std::string(kWidth - filled, '.');
  std::fputs(fmt::format("\r[{}] {:3.0f}% {} left ", bar, share * 100, clock_text(seconds_left)).c_str(), stderr);
  std::fflush(stderr);
  bar_shown_ = true;
}

}  // namespace umbrix::app
