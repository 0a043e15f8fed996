// SPDX-License-Identifier: Apache-2.0
#include "tile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>

#include "strict_number.h"

namespace umbrix::app {

bool parse_tile(const std::string& text, Tile& out) {
  const std::size_t slash = std::min(text.find('/'), text.size());
  std::uint64_t index = 0, count = 0;
  if (!parse_number(text.substr(0, slash), index) || slash == text.size() ||
      !parse_number(text.substr(slash + 1), count) || count > kMostTiles || index >= count) {
    return false;
  }
  out = {static_cast<int>(index), static_cast<int>(count)};
  return true;
}

std::string tile_text(const Tile& tile) { return fmt::format("{}/{}", tile.index, tile.count); }

Status tile_window(const Size& frame, const Tile& tile, render::Crop& out) {
  int columns = 0;
  double best = 0;
  for (int c = 1; c <= tile.count; ++c) {
    const int rows = tile.count / c;
    if (tile.count % c != 0 || c > frame.width || rows > frame.height) continue;
    // Long side over short side.
    const double aspect = static_cast<double>(frame.width) * rows / (static_cast<double>(frame.height) * c);
    const double stretch = std::max(aspect, 1 / aspect);
    if (columns > 0 && stretch >= best) continue;
    columns = c;
    best = stretch;
  }
  if (columns == 0) {
    return {StatusCode::invalid_argument, fmt::format("--tile: an image of {}x{} cannot be cut into {} equal tiles",
                                                      frame.width, frame.height, tile.count)};
  }
  const int rows = tile.count / columns;
  const auto edge = [](int size, int i, int parts) { return static_cast<int>(std::int64_t{size} * i / parts); };
  const int column = tile.index % columns, row = tile.index / columns;
  out.x = edge(frame.width, column, columns);
  out.y = edge(frame.height, row, rows);
  out.width = edge(frame.width, column + 1, columns) - out.x;
  out.height = edge(frame.height, row + 1, rows) - out.y;
  return {};
}

std::string path_of_tile(const std::string& path, const Tile& tile) {
  std::filesystem::path out(path);
  const std::string extension = out.extension().string();
  out.replace_extension();
  return fmt::format("{}.tile{:03}of{:03}{}", out.string(), tile.index, tile.count, extension);
}

}  // namespace umbrix::app
