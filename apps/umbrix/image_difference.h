// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/image_metrics.h"
#include "umbrix/io/image_file.h"
#include "umbrix/status.h"

namespace umbrix::app {

/// How far a channel is from that of the reference.
struct ChannelDifference {
  std::string name;
  double rmse = 0;     ///< root of the mean squared difference
  double mean = 0;     ///< of the differences, with their signs
  double largest = 0;  ///< without its sign
  int x = 0, y = 0;    ///< where that is
};

/// Of two images of one size, by the names of their channels.
struct ImageDifference {
  std::vector<ChannelDifference> channels;   ///< that both have
  std::optional<render::ImageError> colour;  ///< of R, G and B, if both have them
  std::uint64_t pixels = 0;
  std::uint64_t different = 0;   ///< pixels of which a common channel differs
  std::uint64_t not_finite = 0;  ///< of those, where a value is not finite: these count as 0 in all other measures
  std::vector<std::string> only_in_image, only_in_reference;

  double largest_rmse() const;
};

/// Compares, and makes the image of the common channels' differences without their signs. invalid_argument: the images
/// do not have the same size, place in the frame or any channel in common.
Status compare_images(const io::Image& image, const io::Image& reference, ImageDifference& out, io::Image& picture);

}  // namespace umbrix::app
