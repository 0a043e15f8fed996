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

using Color = std::array<float, 3>;

Color multiply(const float (&m)[3][3], const Color& v) {
  Color out;
  for (std::size_t row = 0; row < 3; ++row) out[row] = m[row][0] * v[0] + m[row][1] * v[1] + m[row][2] * v[2];
  return out;
}

// Sobotka 2022, "AgX": colours go towards white as they get brighter, as film's do, and keep their hue longer than with
// a curve on each channel. Its curve as the polynomial of Wrensch 2023, "Minimal AgX Implementation".
Color agx(const Color& linear) {
  constexpr float kInset[3][3] = {{0.842479062f, 0.0784336f, 0.0792237451f},
                                  {0.0423282422f, 0.878468636f, 0.0791661275f},
                                  {0.0423756549f, 0.0784336f, 0.879142974f}};
  constexpr float kOutset[3][3] = {{1.19687901f, -0.0980208811f, -0.0990297441f},
                                   {-0.0528968518f, 1.15190313f, -0.0989611768f},
                                   {-0.0529716355f, -0.0980434501f, 1.15107367f}};
  constexpr float kLeastStops = -12.47393f, kMostStops = 4.026069f;
  Color v = multiply(kInset, linear);
  for (float& x : v) {
    const float stops = std::clamp(std::log2(std::max(x, 1e-10f)), kLeastStops, kMostStops);
    const float t = (stops - kLeastStops) / (kMostStops - kLeastStops), t2 = t * t, t4 = t2 * t2;
    x = 15.5f * t4 * t2 - 40.14f * t4 * t + 31.96f * t4 - 6.868f * t2 * t + 0.4298f * t2 + 0.1191f * t - 0.00232f;
  }
  v = multiply(kOutset, v);
  for (float& x : v) x = std::pow(std::max(x, 0.0f), 2.2f);  // its display's curve, undone
  return v;
}

float srgb_curve(float x) { return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f; }

void display(Color color, float scale, ToneMap tone_map, std::uint8_t* out) {
  for (float& x : color) x = x * scale > 0 ? std::min(x * scale, 1e30f) : 0;  // also NaN
  if (tone_map == ToneMap::agx) color = agx(color);
  for (float x : color) {
    if (tone_map == ToneMap::aces) x = aces(x);
    x = std::min(x, 1.0f);
    if (tone_map != ToneMap::none) x = srgb_curve(x);
    *out++ = static_cast<std::uint8_t>(std::lround(std::min(x, 1.0f) * 255));
  }
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
    const float* const pixel = &image.pixels[i * channels];
    display({pixel[source[0]], pixel[source[1]], pixel[source[2]]}, scale, options.tone_map, &pixels[i * 3]);
  }

  OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", options.tone_map == ToneMap::none ? "Linear" : "sRGB");
  set_common_attributes(spec, image);
  return write_with_oiio("png", file, spec, OIIO::TypeDesc::UINT8, pixels.data());
}

}  // namespace umbrix::io::detail
