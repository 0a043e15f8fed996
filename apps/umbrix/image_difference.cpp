// SPDX-License-Identifier: Apache-2.0
#include "image_difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace umbrix::app {
namespace {

/// A channel that both have: its name and its place among the channels of each.
struct CommonChannel {
  std::string name;
  std::size_t in_image = 0, in_reference = 0;
};

std::size_t place_of(const io::Image& image, const std::string& channel) {
  return static_cast<std::size_t>(std::find(image.channels.begin(), image.channels.end(), channel) -
                                  image.channels.begin());
}

std::vector<std::string> channels_not_in(const io::Image& image, const io::Image& other) {
  std::vector<std::string> names;
  for (const std::string& name : image.channels) {
    if (place_of(other, name) == other.channels.size()) names.push_back(name);
  }
  return names;
}

std::vector<CommonChannel> common_channels(const io::Image& image, const io::Image& reference) {
  std::vector<CommonChannel> common;
  for (std::size_t i = 0; i < image.channels.size(); ++i) {
    const std::size_t j = place_of(reference, image.channels[i]);
    if (j < reference.channels.size()) common.push_back({image.channels[i], i, j});
  }
  return common;
}

Status check_alike(const io::Image& image, const io::Image& reference) {
  const auto wrong = [](const std::string& reason) { return Status(StatusCode::invalid_argument, reason); };
  if (image.width != reference.width || image.height != reference.height) {
    return wrong(fmt::format("the images are of {}x{} and {}x{} pixels", image.width, image.height, reference.width,
                             reference.height));
  }
  if (image.x != reference.x || image.y != reference.y) {
    return wrong(fmt::format("the images begin at +{}+{} and +{}+{} of their frames", image.x, image.y, reference.x,
                             reference.y));
  }
  return {};
}

/// The two values of a channel in a pixel; zeros where they cannot be subtracted.
struct Values {
  float image = 0, reference = 0;
  bool same = true, finite = true;
};

Values values_of(float image, float reference) {
  const bool same = image == reference || (std::isnan(image) && std::isnan(reference));
  if (!std::isfinite(image) || !std::isfinite(reference)) return {0, 0, same, same};
  return {image, reference, same, true};
}

void start_picture(const io::Image& image, const std::vector<CommonChannel>& common, io::Image& picture) {
  picture = image;
  picture.metadata.clear();
  picture.matrices.clear();
  picture.channels.clear();
  for (const CommonChannel& channel : common) picture.channels.push_back(channel.name);
  const std::size_t pixels = image.pixels.size() / image.channels.size();
  picture.pixels.assign(pixels * common.size(), 0);
}

/// What pixels are marked with.
enum : std::uint8_t { kDifferent = 1, kNotFinite = 2 };

/// R, G and B of both images, for the metrics.
struct Colours {
  render::RgbValues image, reference;
};

/// The place of a channel in a colour; 3 if it is not in it.
std::size_t colour_place(const std::string& channel) {
  return channel == "R" ? 0 : channel == "G" ? 1 : channel == "B" ? 2 : 3;
}

/// Compares the channel that is number `c` in `picture`.
ChannelDifference compare_channel(const io::Image& image, const io::Image& reference, const CommonChannel& channel,
                                  std::size_t c, io::Image& picture, std::vector<std::uint8_t>& marks,
                                  Colours& colours) {
  ChannelDifference out;
  out.name = channel.name;
  const std::size_t place = colour_place(channel.name);
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const Values values = values_of(image.pixels[i * image.channels.size() + channel.in_image],
                                    reference.pixels[i * reference.channels.size() + channel.in_reference]);
    const double difference = double{values.image} - double{values.reference};
    out.rmse += difference * difference;
    out.mean += difference;
    if (std::abs(difference) > out.largest) {
      out.largest = std::abs(difference);
      out.x = static_cast<int>(i % static_cast<std::size_t>(image.width));
      out.y = static_cast<int>(i / static_cast<std::size_t>(image.width));
    }
    picture.pixels[i * picture.channels.size() + c] = static_cast<float>(std::abs(difference));
    if (!values.same) marks[i] |= kDifferent;
    if (!values.finite) marks[i] |= kNotFinite;
    if (place < 3 && !colours.image.empty()) {
      colours.image[3 * i + place] = double{values.image};
      colours.reference[3 * i + place] = double{values.reference};
    }
  }
  out.rmse = std::sqrt(out.rmse / static_cast<double>(marks.size()));
  out.mean /= static_cast<double>(marks.size());
  return out;
}

}  // namespace

double ImageDifference::largest_rmse() const {
  double largest = 0;
  for (const ChannelDifference& channel : channels) largest = std::max(largest, channel.rmse);
  return largest;
}

Status compare_images(const io::Image& image, const io::Image& reference, ImageDifference& out, io::Image& picture) {
  out = {};
  if (Status status = check_alike(image, reference); !status) return status;
  const std::vector<CommonChannel> common = common_channels(image, reference);
  if (common.empty()) return {StatusCode::invalid_argument, "the images have no channel in common"};
  start_picture(image, common, picture);
  out.pixels = image.pixels.size() / image.channels.size();
  out.only_in_image = channels_not_in(image, reference);
  out.only_in_reference = channels_not_in(reference, image);

  std::vector<std::uint8_t> marks(out.pixels);
  Colours colours;
  const auto is_colour = [](const CommonChannel& channel) { return colour_place(channel.name) < 3; };
  const bool coloured = std::count_if(common.begin(), common.end(), is_colour) == 3;
  if (coloured) colours = {render::RgbValues(3 * out.pixels), render::RgbValues(3 * out.pixels)};
  for (std::size_t c = 0; c < common.size(); ++c) {
    out.channels.push_back(compare_channel(image, reference, common[c], c, picture, marks, colours));
  }
  for (const std::uint8_t mark : marks) {
    out.different += (mark & kDifferent) != 0 ? 1u : 0u;
    out.not_finite += (mark & kNotFinite) != 0 ? 1u : 0u;
  }
  if (coloured) out.colour = render::image_error(colours.image, colours.reference);
  return {};
}

}  // namespace umbrix::app
