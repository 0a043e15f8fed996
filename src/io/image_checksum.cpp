// SPDX-License-Identifier: Apache-2.0
#include "io/image_checksum.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "io/hash_state.h"

namespace umbrix::io {
namespace {

// The positions of the names in the order of the names.
std::vector<std::size_t> sorted_order(const std::vector<std::string>& names) {
  std::vector<std::size_t> order(names.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return names[a] < names[b]; });
  return order;
}

bool is_checked_text(const std::string& name) {
  return name.rfind("umbrix:", 0) == 0 && name != detail::kChecksumAttribute;
}

void add_header(const Image& image, detail::HashState& hash) {
  const std::int32_t window[] = {image.x,
                                 image.y,
                                 image.width,
                                 image.height,
                                 image.frame_width > 0 ? image.frame_width : image.width,
                                 image.frame_height > 0 ? image.frame_height : image.height};
  hash.add(window, sizeof window);
  auto texts = image.metadata;
  std::sort(texts.begin(), texts.end());
  for (const auto& [name, value] : texts) {
    if (!is_checked_text(name)) continue;
    hash.add_text(name);
    hash.add_text(value);
  }
  auto matrices = image.matrices;
  std::sort(matrices.begin(), matrices.end());
  for (const auto& [name, values] : matrices) {
    hash.add_text(name);
    hash.add(values.data(), values.size() * sizeof(float));
  }
}

}  // namespace

namespace detail {

std::string checksum_of(const Image& image, const std::vector<float>& pixels) {
  HashState hash;
  add_header(image, hash);
  // Files have their channels in an order of their own.
  const std::vector<std::size_t> order = sorted_order(image.channels);
  for (const std::size_t c : order) hash.add_text(image.channels[c]);
  const std::size_t channels = order.size(), row = static_cast<std::size_t>(image.width) * channels;
  if (row == 0) return hash.digits();
  std::vector<float> values(row);
  for (std::size_t begin = 0; begin < pixels.size(); begin += row) {
    for (std::size_t i = 0; i < row; ++i) {
      const float value = pixels[begin + i / channels * channels + order[i % channels]];
      // One NaN for all: which one it is may change when pixels are converted.
      values[i] = std::isnan(value) ? std::numeric_limits<float>::quiet_NaN() : value;
    }
    hash.add(values.data(), row * sizeof(float));
  }
  return hash.digits();
}

}  // namespace detail

std::string image_checksum(const Image& image) { return detail::checksum_of(image, image.pixels); }

}  // namespace umbrix::io
