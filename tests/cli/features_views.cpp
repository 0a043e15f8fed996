// SPDX-License-Identifier: Apache-2.0
// Cameras, and lights on a white floor that only spreads light: what is seen is the irradiance over pi.
#include <algorithm>
#include <cmath>

#include "feature_cases.h"

namespace umbrix::app {
namespace {

/// KHR_lights_punctual: 4 pi candela at a height of 2, seen from a point of the floor, times the cosine there.
double lamp(double distance) {
  const double d2 = 4 + distance * distance;
  return 4 / d2 * 2 / std::sqrt(d2);
}

/// The window that ends a light at a range of 4.
double window(double distance) {
  const double share = std::pow((4 + distance * distance) / 16, 2);
  return std::max(1 - share, 0.0);
}

/// The fall from an inner angle of 0.4 to an outer one of 0.8.
double cone(double distance) {
  const double cosine = 2 / std::sqrt(4 + distance * distance);
  const double ramp = (cosine - std::cos(0.8)) / (std::cos(0.4) - std::cos(0.8));
  return std::pow(std::clamp(ramp, 0.0, 1.0), 2);
}

/// Along the row of pixels whose centres are at y = 0.5 + 1/32; the light is above (0.5, 0.5).
template <class Value>
std::vector<Probe> along_floor(Value value) {
  std::vector<Probe> out;
  for (const double pixel : {4.5, 8.5, 16.5, 24.5, 28.5, 32.5, 48.5, 63.5}) {
    const double x = pixel / 16;
    out.push_back({x, 0.5 + 1. / 32, value(std::hypot(x - 0.5, 1. / 32))});
  }
  return out;
}

/// The share of the sky that a square takes of which a point is 1 below the centre: four times that of a unit square
/// from below its corner, each of whose two terms is atan(1 / sqrt 2) / (2 pi sqrt 2) (Howell, configuration B-4).
double square_above() { return 4 * 2 * std::atan(std::sqrt(0.5)) * std::sqrt(0.5) / (2 * std::acos(-1.0)); }

std::vector<FeatureCase> camera_cases() {
  const Probe near_one = {0.5, 0.5, kGreen}, far_one = {1.5, 1.5, kWhite};
  return {
      {"Cameras.gltf",
       2,
       2,
       {near_one, far_one, {0.5, 1.5, kBlack}, {1.05, 1.95, kWhite}, {0.05, 0.05, kGreen}},
       {"--camera", "0"}},
      // At half the distance what is 1 from the middle is 2 from it in the picture; the far square stays as it was.
      {"Cameras.gltf",
       2,
       2,
       {near_one, far_one, {0.5, 1.5, kBlack}, {1.05, 1.95, kWhite}, {0.95, 0.95, kGreen}},
       {"--camera", "1"}},
      {"Cameras.gltf", 2, 2, {{0.5, 0.5, kBlack}, far_one, {1.95, 1.05, kWhite}}, {"--camera", "2"}},
      {"Cameras.gltf", 2, 2, {near_one, {1.5, 1.5, kBlack}}, {"--camera", "3"}},
  };
}

std::vector<FeatureCase> light_cases() {
  return {
      {"DirectionalLight.gltf", 1, 1, squares({{0.8, 0.5, 0}})},
      {"LightsPunctualLamp.gltf", 4, 1, along_floor([](double d) {
         return Color{lamp(d), lamp(d) * window(d), 0};
       })},
      {"SpotLight.gltf", 4, 1, along_floor([](double d) { return grey(lamp(d) * cone(d)); })},
      // 64 samples in each of 25 pixels. A sample is off by less than half of the value, so that the mean is off by
      // less than 4 / 2 / sqrt(1600) of it.
      {"EmissiveMeshLight.gltf",
       1,
       1,
       {{0.5, 0.5, {square_above(), square_above() / 2, square_above() / 4}, 0.05 * square_above(), 0.25}},
       {"--spp", "64"}},
  };
}

}  // namespace

std::vector<FeatureCase> view_cases() {
  std::vector<FeatureCase> cases = camera_cases();
  for (FeatureCase& one : light_cases()) cases.push_back(std::move(one));
  return cases;
}

}  // namespace umbrix::app
