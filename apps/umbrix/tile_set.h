// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tile.h"
#include "umbrix/io/image_file.h"

namespace umbrix::app {

/// Puts the tiles of a frame together, in any order.
class TileSet {
 public:
  /// Reads a tile and pastes it. bad_input, naming the file: it is no tile of `umbrix render --tile`, or not whole, or
  /// it does not go with those before, or is there already.
  Status add(const std::string& path);

  /// Those that are not there yet, of a set to which something was added.
  std::vector<int> missing() const;

  int count() const noexcept { return count_; }

  /// The frame, with the attributes that it has when it is rendered as one. Of a set that misses nothing.
  const io::Image& frame() const noexcept { return frame_; }

 private:
  Status begin(const std::string& path, const io::Image& tile);

  int count_ = 0;  ///< of tiles; 0: nothing was added
  std::string first_path_;
  std::vector<std::string> paths_;  ///< by tile; empty: missing
  io::Image frame_;
};

}  // namespace umbrix::app
