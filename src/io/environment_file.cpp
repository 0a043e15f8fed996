// SPDX-License-Identifier: Apache-2.0
// Maps of the sky, in the two formats that hold linear radiance. Others are refused: their colours are made for a
// screen.
#include "io/environment_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "io/image_input.h"
#include "io/load_error.h"

namespace umbrix::io::detail {
namespace {

// Which channels are red, green and blue; one channel alone is grey.
std::array<int, 3> color_channels(const OIIO::ImageSpec& spec) {
  std::array<int, 3> channels{};
  for (std::size_t c = 0; c < 3; ++c) {
    const std::string_view name = std::array{"R", "G", "B"}[c];
    channels[c] = spec.nchannels == 1 ? 0 : spec.channelindex(OIIO::string_view(name.data(), name.size()));
    if (channels[c] < 0) bad_input("has no channel {}", name);
  }
  return channels;
}

void check_shape(const OIIO::ImageInput& input, const OIIO::ImageSpec& spec, std::uint64_t most_pixels) {
  const std::string_view format = input.format_name();
  if (format != "openexr" && format != "hdr") bad_input("is neither OpenEXR nor Radiance HDR");
  if (spec.deep || spec.depth > 1) bad_input("is not a flat image");
  if (spec.width <= 0 || spec.height <= 0) bad_input("the image is empty");
  const auto pixels = static_cast<std::uint64_t>(spec.width) * static_cast<std::uint64_t>(spec.height);
  if (pixels > most_pixels || spec.nchannels > 64) {
    over_limit("has {}x{} pixels of {} channels, the limit is {} pixels of 64", spec.width, spec.height, spec.nchannels,
               most_pixels);
  }
  if (spec.x != spec.full_x || spec.y != spec.full_y || spec.width != spec.full_width ||
      spec.height != spec.full_height) {
    bad_input("is cropped: its data window is not its display window");
  }
}

// Filters that sharpen leave values below zero, which no light has.
Float3 radiance_of(const float* pixel, const std::array<int, 3>& channels, std::size_t number, int width) {
  Float3 color{};
  for (std::size_t c = 0; c < 3; ++c) {
    const float value = pixel[channels[c]];
    const auto columns = static_cast<std::size_t>(width);
    if (!std::isfinite(value)) bad_input("pixel ({}, {}) is not finite", number % columns, number / columns);
    color[c] = std::max(value, 0.0f);
  }
  return color;
}

}  // namespace

EnvironmentMap read_environment(const std::string& path, std::uint64_t most_pixels) {
  const auto input = open_image(path);
  const OIIO::ImageSpec spec = input->spec();
  check_shape(*input, spec, most_pixels);
  const std::array<int, 3> channels = color_channels(spec);

  EnvironmentMap map;
  map.width = static_cast<std::uint32_t>(spec.width);
  map.height = static_cast<std::uint32_t>(spec.height);
  const auto stride = static_cast<std::size_t>(spec.nchannels);
  std::vector<float> values(std::size_t{map.width} * map.height * stride);
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data())) {
    bad_input("{}", one_line(input->geterror()));
  }
  map.pixels.reserve(values.size() / stride);
  for (std::size_t i = 0; i < values.size(); i += stride) {
    map.pixels.push_back(radiance_of(&values[i], channels, i / stride, spec.width));
  }
  return map;
}

}  // namespace umbrix::io::detail
