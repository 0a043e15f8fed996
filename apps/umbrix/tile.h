// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "frame_size.h"
#include "render/render.h"
#include "umbrix/status.h"

namespace umbrix::app {

/// One of the parts that a frame is cut into, counted row by row from 0.
struct Tile {
  int index = 0;
  int count = 1;
};

constexpr int kMostTiles = 65536;

/// "3/16". False for anything else, and for an index that is not below the count.
bool parse_tile(const std::string& text, Tile& out);

std::string tile_text(const Tile& tile);

/// The tile's part of the frame, from size and count alone: of the ways to cut it into equal rows of equal tiles the
/// one whose tiles are nearest to squares. invalid_argument if there are not enough pixels for each way.
Status tile_window(const Size& frame, const Tile& tile, render::Crop& out);

/// "name.exr" is "name.tile003of016.exr".
std::string path_of_tile(const std::string& path, const Tile& tile);

}  // namespace umbrix::app
