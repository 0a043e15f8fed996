// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "render/tile_store.h"

namespace umbrix::app {

struct CheckpointOptions {
  double interval = 0;    ///< seconds between checkpoints; 0: none but the last
  double time_limit = 0;  ///< seconds until the program ends with kIncomplete; 0: none
  bool resume = false;    ///< go on from checkpoints that are there

  /// Is there a thread that writes checkpoints?
  bool writes() const noexcept { return interval > 0 || time_limit > 0; }
};

/// Keeps the finished tiles of the frame that is rendered in a file beside its output: every so often, on SIGUSR1, at
/// the time limit, and before SIGINT, SIGTERM or SIGHUP end the program; a second signal ends it at once.
class Checkpoints : public render::TileStore {
 public:
  /// Time begins here. `quiet`: says nothing of what is resumed.
  Checkpoints(const CheckpointOptions& options, bool quiet);
  ~Checkpoints() override;
  Checkpoints(const Checkpoints&) = delete;
  Checkpoints& operator=(const Checkpoints&) = delete;

  /// The next render is of what `key` says, kept at `path`.
  void begin_frame(const std::string& path, const std::string& key);
  /// Its outputs are written: removes the file.
  void end_frame();
  /// It will have no end, and its image is about to go: writes a last checkpoint.
  void keep_frame();

  /// Set when the program is about to end, so that what renders stops and leaves the processor to the last checkpoint.
  const std::atomic<bool>& leaving() const noexcept { return leaving_; }
  /// Does not come back if it is: the thread that writes the checkpoint ends the program.
  void wait_if_leaving();

  /// Is there anything to do for a frame?
  bool in_use() const noexcept { return options_.resume || options_.writes(); }

  void begin(const std::vector<render::PixelRect>& tiles, io::Image& image,
             std::vector<std::uint8_t>& finished) override;
  void finish(std::size_t i) override;

 private:
  using Clock = std::chrono::steady_clock;

  void watch();
  void save();
  std::string what_is_kept();
  [[noreturn]] void leave(const std::string& reason, int code);

  const CheckpointOptions options_;
  const bool quiet_;
  const Clock::time_point start_ = Clock::now();
  std::atomic<bool> leaving_{false};
  std::thread watcher_;

  std::mutex frame_mutex_;  ///< held while the frame changes, or its file is written
  std::string path_, key_;
  std::vector<render::PixelRect> tiles_;
  const io::Image* image_ = nullptr;  ///< null: between frames

  std::mutex finished_mutex_;  ///< held for moments only, since tracing threads wait for it
  std::vector<std::uint8_t> finished_;
  std::size_t finished_count_ = 0, kept_count_ = 0;  ///< now, and in the file
};

}  // namespace umbrix::app
