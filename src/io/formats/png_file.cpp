// SPDX-License-Identifier: Apache-2.0
// PNG, 8 bits: R, G, B through exposure, tone map and the sRGB curve (IEC 61966-2-1). OpenImageIO does not convert
// between linear and sRGB when it writes, so it is done here.

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "io/formats/oiio_output.h"
#include "io/image_formats.h"

namespace umbrix::io::detail {
namespace {

// Narkowicz 2015, "ACES Filmic Tone Mapping Curve": a fit to the ACES reference rendering transform.
float aces(float x) {
  if (x > 1e4f) return 1;  // its limit, and no infinity over infinity
  return x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f);
}

float srgb_curve(float x) { return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f; }

std::uint8_t display_value(float linear, float scale, ToneMap tone_map) {
  float x = linear * scale;
  if (!(x > 0)) return 0;  // also NaN
  if (tone_map == ToneMap::aces) x = aces(x);
  x = std::min(x, 1.0f);
  if (tone_map != ToneMap::none) x = srgb_curve(x);
  return static_cast<std::uint8_t>(std::lround(std::min(x, 1.0f) * 255));
}

}  // namespace

Status write_png(AtomicFile& file, const Image& image, const WriteOptions& options) {
  const char* const names[] = {"R", "G", "B"};
  std::array<std::size_t, 3> source{};
  for (std::size_t c = 0; c < 3; ++c) {
    const auto found = std::find(image.channels.begin(), image.channels.end(), names[c]);
    if (found == image.channels.end()) {
      return {StatusCode::invalid_argument, std::string("the image has no channel ") + names[c]};
    }
    source[c] = static_cast<std::size_t>(found - image.channels.begin());
  }

  const std::size_t channels = image.channels.size();
  const std::size_t count = image.pixels.size() / channels;
  const float scale = std::exp2(options.exposure);
  std::vector<std::uint8_t> pixels(count * 3);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      pixels[i * 3 + c] = display_value(image.pixels[i * channels + source[c]], scale, options.tone_map);
    }
  }

  OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", options.tone_map == ToneMap::none ? "Linear" : "sRGB");
  set_common_attributes(spec, image);
  return write_with_oiio("png", file, spec, OIIO::TypeDesc::UINT8, pixels.data());
}

}  // namespace umbrix::io::detail
