// SPDX-License-Identifier: Apache-2.0
// A line, the key, a byte for each tile, the floats of those that are finished row by row, and a hash of all that.
#include "checkpoint_file.h"

#include <algorithm>
#include <cstring>

#include "umbrix/io/content_hash.h"

namespace umbrix::app {
namespace {

constexpr std::string_view kMagic = "umbrix part 1\n";
constexpr std::size_t kHashDigits = 32;

/// Calls `copy` with the begin of each row of each finished tile in the image's pixels, and its number of floats.
template <class Copy>
void for_each_row(const io::Image& image, const std::vector<render::PixelRect>& tiles,
                  const std::vector<std::uint8_t>& finished, Copy copy) {
  const std::size_t channels = image.channels.size();
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const render::PixelRect& tile = tiles[i];
    for (int y = 0; y < tile.height && finished[i]; ++y) {
      const auto row = static_cast<std::size_t>(tile.y + y - image.y) * static_cast<std::size_t>(image.width);
      copy((row + static_cast<std::size_t>(tile.x - image.x)) * channels,
           static_cast<std::size_t>(tile.width) * channels);
    }
  }
}

std::size_t count_floats(const io::Image& image, const std::vector<render::PixelRect>& tiles,
                         const std::vector<std::uint8_t>& finished) {
  std::size_t count = 0;
  for_each_row(image, tiles, finished, [&](std::size_t, std::size_t floats) { count += floats; });
  return count;
}

/// All that is before the floats.
std::string header(const std::string& key, const std::vector<std::uint8_t>& finished) {
  return std::string(kMagic) + key + std::string(finished.begin(), finished.end());
}

}  // namespace

Status write_checkpoint(const std::string& path, const std::string& key, const io::Image& image,
                        const std::vector<render::PixelRect>& tiles, const std::vector<std::uint8_t>& finished) {
  std::string text = header(key, finished);
  text.reserve(text.size() + count_floats(image, tiles, finished) * sizeof(float) + kHashDigits);
  for_each_row(image, tiles, finished, [&](std::size_t begin, std::size_t floats) {
    text.append(reinterpret_cast<const char*>(&image.pixels[begin]), floats * sizeof(float));
  });
  text += io::content_hash(text);
  return io::write_text(path, text, true);
}

bool read_checkpoint(const std::string& path, const std::string& key, const std::vector<render::PixelRect>& tiles,
                     io::Image& image, std::vector<std::uint8_t>& finished) {
  const std::size_t before_tiles = kMagic.size() + key.size();
  const std::size_t largest = before_tiles + tiles.size() + image.pixels.size() * sizeof(float) + kHashDigits;
  std::string text;
  if (!io::read_text(path, largest, text) || text.size() < before_tiles + tiles.size() + kHashDigits) return false;
  const std::string_view content(text.data(), text.size() - kHashDigits);
  if (io::content_hash(content) != std::string_view(text).substr(content.size())) return false;
  if (content.substr(0, before_tiles) != std::string(kMagic) + key) return false;

  std::vector<std::uint8_t> kept(tiles.size());
  std::memcpy(kept.data(), content.data() + before_tiles, kept.size());
  if (std::any_of(kept.begin(), kept.end(), [](std::uint8_t value) { return value > 1; })) return false;
  const char* next = content.data() + before_tiles + kept.size();
  const auto bytes = static_cast<std::size_t>(content.data() + content.size() - next);
  if (bytes != count_floats(image, tiles, kept) * sizeof(float)) return false;
  for_each_row(image, tiles, kept, [&](std::size_t begin, std::size_t floats) {
    std::memcpy(&image.pixels[begin], next, floats * sizeof(float));
    next += floats * sizeof(float);
  });
  finished = kept;
  return true;
}

}  // namespace umbrix::app
