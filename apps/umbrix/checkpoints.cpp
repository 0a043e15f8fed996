// SPDX-License-Identifier: Apache-2.0
#include "checkpoints.h"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <limits>

#include "checkpoint_file.h"
#include "exit_code.h"
#include "leave.h"
#include "message.h"
#include "signals.h"

namespace umbrix::app {

Checkpoints::Checkpoints(const CheckpointOptions& options, bool quiet) : options_(options), quiet_(quiet) {
  if (!options.writes()) return;
  hand_over_signals();
  watcher_ = std::thread([this] { watch(); });
}

Checkpoints::~Checkpoints() {
  if (!watcher_.joinable()) return;
  wake_signal_waiter();
  watcher_.join();
}

void Checkpoints::begin_frame(const std::string& path, const std::string& key) {
  const std::lock_guard<std::mutex> lock(frame_mutex_);
  path_ = path;
  key_ = key;
}

void Checkpoints::begin(const std::vector<render::PixelRect>& tiles, io::Image& image,
                        std::vector<std::uint8_t>& finished) {
  const std::lock_guard<std::mutex> lock(frame_mutex_);
  const bool found = options_.resume && read_checkpoint(path_, key_, tiles, image, finished);
  tiles_ = tiles;
  image_ = &image;
  const std::lock_guard<std::mutex> lock_finished(finished_mutex_);
  finished_ = finished;
  finished_count_ = static_cast<std::size_t>(std::count(finished.begin(), finished.end(), std::uint8_t{1}));
  kept_count_ = finished_count_;
  if (found && !quiet_)
    say(fmt::format("umbrix: going on from {} of {} tiles in {}", kept_count_, tiles.size(), path_));
}

void Checkpoints::finish(std::size_t i) {
  const std::lock_guard<std::mutex> lock(finished_mutex_);
  finished_[i] = 1;
  ++finished_count_;
}

void Checkpoints::wait_if_leaving() {
  if (leaving_) watcher_.join();
}

void Checkpoints::keep_frame() {
  if (options_.writes()) save();
  const std::lock_guard<std::mutex> lock(frame_mutex_);
  image_ = nullptr;
}

void Checkpoints::end_frame() {
  const std::lock_guard<std::mutex> lock(frame_mutex_);
  if (!image_) return;
  image_ = nullptr;
  std::error_code error;
  std::filesystem::remove(path_, error);
}

void Checkpoints::save() {
  const std::lock_guard<std::mutex> lock(frame_mutex_);
  if (!image_) return;
  std::vector<std::uint8_t> finished;
  std::size_t count = 0;
  {
    const std::lock_guard<std::mutex> lock_finished(finished_mutex_);
    if (finished_count_ == kept_count_) return;
    finished = finished_;
    count = finished_count_;
  }
  // The pixels of finished tiles stay as they are, whoever else writes to the image.
  if (Status status = write_checkpoint(path_, key_, *image_, tiles_, finished); !status) {
    say_warning(status.message());
    return;
  }
  const std::lock_guard<std::mutex> lock_finished(finished_mutex_);
  kept_count_ = count;
}

std::string Checkpoints::what_is_kept() {
  const std::lock_guard<std::mutex> lock(frame_mutex_);
  const std::lock_guard<std::mutex> lock_finished(finished_mutex_);
  if (!image_ || kept_count_ == 0) return "";
  return fmt::format("; {} has {} of {} tiles, --resume goes on from there", path_, kept_count_, tiles_.size());
}

void Checkpoints::leave(const std::string& reason, int code) {
  leave_at_once(printable("umbrix: " + reason + what_is_kept()).append(1, '\n').c_str(), code);
}

void Checkpoints::watch() {
  const auto after = [](Clock::time_point time, double seconds) {
    return time + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  };
  const Clock::time_point never = Clock::time_point::max();
  const Clock::time_point end = options_.time_limit > 0 ? after(start_, options_.time_limit) : never;
  for (;;) {
    const Clock::time_point next = options_.interval > 0 ? after(Clock::now(), options_.interval) : never;
    const WaitResult result = wait_for_signal(std::min(next, end));
    if (result.woken) return;
    const bool interrupted = result.signal != 0 && result.signal != SIGUSR1, late = Clock::now() >= end;
    leaving_ = interrupted || late;
    save();
    if (interrupted) leave("interrupted", 128 + result.signal);
    if (late) {
      leave(fmt::format("the time limit of {} s was reached (--time-limit)", options_.time_limit), kIncomplete);
    }
  }
}

}  // namespace umbrix::app
