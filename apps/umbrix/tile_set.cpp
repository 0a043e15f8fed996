// SPDX-License-Identifier: Apache-2.0
#include "tile_set.h"

#include <fmt/format.h>

#include <algorithm>

#include "image_metadata.h"

namespace umbrix::app {
namespace {

/// As much as can be read again.
constexpr std::uint64_t kMostFloats = 1ull << 31;

Status refuse(const std::string& path, const std::string& reason) {
  return {StatusCode::bad_input, fmt::format("{}: {}", path, reason)};
}

/// What a tile says of itself that is not of the frame. The rest is what the format adds on reading.
bool is_of_frame(const std::string& name) {
  const bool ours = name.rfind("umbrix:", 0) == 0 || name == "Software";
  return ours && name != "umbrix:tile" && name != "umbrix:checksum";
}

Metadata metadata_of_frame(const io::Image& tile) {
  Metadata metadata;
  for (const auto& attribute : tile.metadata) {
    if (is_of_frame(attribute.first)) metadata.push_back(attribute);
  }
  std::sort(metadata.begin(), metadata.end());
  return metadata;
}

Status read_tile(const std::string& path, io::Image& image, Tile& tile) {
  if (Status status = io::read_image(path, image); !status) return status;
  if (!parse_tile(value_of(image.metadata, "umbrix:tile"), tile)) {
    return refuse(path, "is no tile: it has no umbrix:tile, which 'umbrix render --tile' writes");
  }
  if (value_of(image.metadata, "umbrix:checksum") != io::image_checksum(image)) {
    return refuse(path, "is damaged: its pixels or attributes are not those of its umbrix:checksum");
  }
  render::Crop window;
  const Status status = tile_window({image.frame_width, image.frame_height}, tile, window);
  if (!status || window.x != image.x || window.y != image.y || window.width != image.width ||
      window.height != image.height) {
    return refuse(path, fmt::format("is not where tile {} of a frame of {}x{} is", tile_text(tile), image.frame_width,
                                    image.frame_height));
  }
  return {};
}

void paste(const io::Image& tile, io::Image& frame) {
  const std::size_t row = static_cast<std::size_t>(tile.width) * tile.channels.size();
  for (int y = 0; y < tile.height; ++y) {
    const auto to =
        static_cast<std::size_t>(tile.y + y) * static_cast<std::size_t>(frame.width) + static_cast<std::size_t>(tile.x);
    std::copy_n(&tile.pixels[static_cast<std::size_t>(y) * row], row, &frame.pixels[to * frame.channels.size()]);
  }
}

}  // namespace

Status TileSet::begin(const std::string& path, const io::Image& tile) {
  first_path_ = path;
  frame_.width = tile.frame_width;
  frame_.height = tile.frame_height;
  frame_.pixel_type = tile.pixel_type;
  frame_.channels = tile.channels;
  frame_.metadata = metadata_of_frame(tile);
  frame_.matrices = tile.matrices;
  const auto pixels = static_cast<std::uint64_t>(tile.frame_width) * static_cast<std::uint64_t>(tile.frame_height);
  if (pixels > kMostFloats / tile.channels.size()) {
    return {StatusCode::resource_limit,
            fmt::format("{}: a frame of {}x{} pixels is too large", path, tile.frame_width, tile.frame_height)};
  }
  frame_.pixels.resize(pixels * tile.channels.size());
  return {};
}

Status TileSet::add(const std::string& path) {
  io::Image image;
  Tile tile;
  if (Status status = read_tile(path, image, tile); !status) return status;
  if (count_ == 0) {
    if (Status status = begin(path, image); !status) return status;
    count_ = tile.count;
    paths_.resize(static_cast<std::size_t>(count_));
  }
  const auto differ = [&](const char* what) {
    return refuse(path, fmt::format("goes not with {}: {} differs", first_path_, what));
  };
  if (tile.count != count_) return differ("the number of tiles");
  if (image.frame_width != frame_.width || image.frame_height != frame_.height) return differ("the frame's size");
  if (image.channels != frame_.channels) return differ("the list of channels");
  if (image.pixel_type != frame_.pixel_type) return differ("the type of pixels");
  if (const std::string name = first_difference(metadata_of_frame(image), frame_.metadata); !name.empty()) {
    return differ(name.c_str());
  }
  if (image.matrices != frame_.matrices) return differ("a matrix");
  std::string& known = paths_[static_cast<std::size_t>(tile.index)];
  if (!known.empty()) return refuse(path, fmt::format("is tile {}, as is {}", tile_text(tile), known));
  known = path;
  paste(image, frame_);
  return {};
}

std::vector<int> TileSet::missing() const {
  std::vector<int> indices;
  for (int i = 0; i < count_; ++i) {
    if (paths_[static_cast<std::size_t>(i)].empty()) indices.push_back(i);
  }
  return indices;
}

}  // namespace umbrix::app
