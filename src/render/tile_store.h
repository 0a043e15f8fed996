// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/pixel_rect.h"
#include "umbrix/io/image_file.h"

namespace umbrix::render {

/// Keeps the tiles that a render has finished, so that another render can go on from them.
class TileStore {
 public:
  virtual ~TileStore() = default;

  /// Before any tile is rendered: the tiles, in pixels of the frame, and the image that they go to, which stays where
  /// it is until render returns. For tiles that are kept from before it fills in their pixels and sets `finished[i]`.
  virtual void begin(const std::vector<PixelRect>& tiles, io::Image& image, std::vector<std::uint8_t>& finished) = 0;

  /// The pixels of tile i are in the image, and stay as they are. Called by one thread at a time.
  virtual void finish(std::size_t i) = 0;
};

}  // namespace umbrix::render
