// SPDX-License-Identifier: Apache-2.0
// OpenEXR: every channel as it is, linear, with the colour space said in numbers (ITU-R BT.709 primaries, D65).

#include <OpenImageIO/half.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "io/formats/oiio_output.h"
#include "io/image_checksum.h"
#include "io/image_formats.h"

namespace umbrix::io::detail {
namespace {

constexpr float kLargestHalf = 65504.0f;
constexpr float kRec709[8] = {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};

// Distances need more than the eleven bits of a half.
bool is_depth(const std::string& channel) {
  return channel == "Z" || (channel.size() > 2 && channel.compare(channel.size() - 2, 2, ".Z") == 0);
}

// What the file will hold: a bright pixel stays finite (halves end at 65504 and would become infinite).
void round_to_half(std::vector<float>& pixels, std::size_t channel, std::size_t channels) {
  for (std::size_t i = channel; i < pixels.size(); i += channels) {
    if (std::isfinite(pixels[i])) pixels[i] = std::clamp(pixels[i], -kLargestHalf, kLargestHalf);
    pixels[i] = half(pixels[i]);
  }
}

OIIO::ImageSpec spec_of(const Image& image, OIIO::TypeDesc::BASETYPE type) {
  OIIO::ImageSpec spec(image.width, image.height, static_cast<int>(image.channels.size()), type);
  spec.x = image.x;
  spec.y = image.y;
  spec.full_x = spec.full_y = 0;
  spec.full_width = image.frame_width > 0 ? image.frame_width : image.width;
  spec.full_height = image.frame_height > 0 ? image.frame_height : image.height;
  spec.channelnames = image.channels;
  spec.attribute("compression", "zip");
  spec.attribute("oiio:ColorSpace", "Linear");
  spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), kRec709);
  set_common_attributes(spec, image);
  for (const auto& [name, values] : image.matrices) {
    spec.attribute(name, OIIO::TypeDesc::TypeMatrix, values.data());
  }
  return spec;
}

}  // namespace

Status write_exr(AtomicFile& file, const Image& image, const WriteOptions& options) {
  const bool is_half = options.pixel_type == PixelType::half;
  OIIO::ImageSpec spec = spec_of(image, is_half ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT);
  if (!is_half) {
    spec.attribute(kChecksumAttribute, image_checksum(image));
    return write_with_oiio("openexr", file, spec, OIIO::TypeDesc::FLOAT, image.pixels.data());
  }
  std::vector<float> pixels = image.pixels;
  const std::size_t channels = image.channels.size();
  spec.channelformats.assign(channels, OIIO::TypeDesc::HALF);
  for (std::size_t c = 0; c < channels; ++c) {
    if (is_depth(image.channels[c])) {
      spec.channelformats[c] = OIIO::TypeDesc::FLOAT;
    } else {
      round_to_half(pixels, c, channels);
    }
  }
  spec.attribute(kChecksumAttribute, checksum_of(image, pixels));
  return write_with_oiio("openexr", file, spec, OIIO::TypeDesc::FLOAT, pixels.data());
}

}  // namespace umbrix::io::detail
