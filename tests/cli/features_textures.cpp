// SPDX-License-Identifier: Apache-2.0
// Textures, on surfaces that look like their colour. (0, 0) is a picture's upper left corner (section 3.8.3).
#include <cmath>

#include "feature_cases.h"

namespace umbrix::app {
namespace {

/// The quarters of the unit square at x: upper left, upper right, lower left, lower right.
std::vector<Probe> quarters(double x, const Color& a, const Color& b, const Color& c, const Color& d) {
  return {{x + 0.25, 0.75, a}, {x + 0.75, 0.75, b}, {x + 0.25, 0.25, c}, {x + 0.75, 0.25, d}};
}

/// Six stripes from the left, in the square whose corner this is; or from the top.
std::vector<Probe> stripes(double x, double y, bool down, const std::vector<Color>& colors) {
  std::vector<Probe> out;
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const double at = (static_cast<double>(i) + 0.5) / 6;
    out.push_back(down ? Probe{x + 0.3, y + 1 - at, colors[i]} : Probe{x + at, y + 0.3, colors[i]});
  }
  return out;
}

FeatureCase settings_case() {
  FeatureCase out{"TextureSettingsTest.gltf", 3, 2, {}};
  const std::vector<Color> patterns[] = {{kRed, kGreen, kRed, kGreen, kRed, kGreen},
                                         {kRed, kRed, kRed, kGreen, kGreen, kGreen},
                                         {kGreen, kRed, kRed, kGreen, kGreen, kRed}};
  double x = 0;
  for (const std::vector<Color>& pattern : patterns) {
    out.probes = out.probes + stripes(x, 1, false, pattern) + stripes(x, 0, true, pattern);
    ++x;
  }
  return out;
}

/// Between the centres of two texels, at 1/4 and 3/4, colours are blended as light: from black to white evenly. To the
/// nearest texel there is an edge in the middle.
std::vector<Probe> ramp(double x, bool linear) {
  std::vector<Probe> out;
  for (const double pixel : {1.5, 5.5, 7.5, 8.5, 11.5, 14.5}) {
    const double at = pixel / 16, even = std::fmin(std::fmax(2 * at - 0.5, 0), 1);
    out.push_back({x + at, 0.3, grey(linear ? even : at < 0.5 ? 0 : 1)});
  }
  return out;
}

}  // namespace

double from_srgb(double code) {
  const double c = code / 255;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

std::vector<FeatureCase> texture_cases() {
  const double half = from_srgb(188);
  return {
      {"BoxTextured.gltf", 2, 1, squares({{1, half, 0}, grey(half / 2)})},
      {"TextureCoordinateTest.gltf", 3, 1,
       quarters(0, kRed, kGreen, kBlue, kWhite) + quarters(1, kRed, kGreen, kBlue, kWhite) +
           quarters(2, kRed, kGreen, kBlue, kWhite)},
      settings_case(),
      {"TextureLinearInterpolationTest.gltf", 3, 1, ramp(0, false) + ramp(1, true) + ramp(2, true)},
      // Grey, grey with alpha, colour, colour with alpha: sRGB all.
      {"TextureEncodingTest.gltf", 4, 1, squares({grey(half), grey(half), {1, half, 0}, {half, 0, 1}})},
      // Half a picture to the side; twice beside each other; a quarter of a picture, turned clockwise, which is what
      // the extension's text says of these numbers; the other set of coordinates.
      {"TextureTransformTest.gltf", 4, 1,
       quarters(0, kGreen, kRed, kWhite, kBlue) +
           std::vector<Probe>{{1.1, 0.75, kRed},
                              {1.4, 0.75, kGreen},
                              {1.6, 0.75, kRed},
                              {1.9, 0.75, kGreen},
                              {1.1, 0.25, kBlue},
                              {1.4, 0.25, kWhite},
                              {1.6, 0.25, kBlue},
                              {1.9, 0.25, kWhite}} +
           quarters(2, kBlue, kRed, kWhite, kGreen) + quarters(3, kRed, kGreen, kBlue, kWhite)},
      {"MultiUVTest.gltf", 2, 1, squares({kBlue, kRed})},
  };
}

}  // namespace umbrix::app
