// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

namespace umbrix::app {

using Color = std::array<double, 3>;

constexpr Color kBlack = {0, 0, 0}, kWhite = {1, 1, 1}, kRed = {1, 0, 0}, kGreen = {0, 1, 0}, kBlue = {0, 0, 1};

constexpr Color grey(double value) { return {value, value, value}; }

/// What a picture shows at a place, in units of the scene from the lower left corner.
struct Probe {
  double x, y;
  Color color;
  double tolerance = 1e-6;  ///< the rounding of floats; more only with a reason
  double side = 0;          ///< of the square around it over which the mean is taken; 0: one pixel
};

/// A file of tests/scenes/features, how it is rendered, and what glTF's text says is then seen.
struct FeatureCase {
  std::string file;
  int width, height;  ///< of what its camera shows, in units of the scene
  std::vector<Probe> probes;
  std::vector<std::string> arguments = {};
  std::string ignored = "";  ///< what the program says to ignore; it says nothing else
  std::string reader = "";   ///< the library without which the build refuses the file
};

/// Two places, in either triangle, of each unit square of a row, from the left.
std::vector<Probe> squares(const std::vector<Color>& colors, double tolerance = 1e-6, double y = 0);

/// The probes of two rows.
std::vector<Probe> operator+(std::vector<Probe> one, const std::vector<Probe>& other);

std::vector<FeatureCase> geometry_cases();
std::vector<FeatureCase> material_cases();
std::vector<FeatureCase> texture_cases();
std::vector<FeatureCase> view_cases();
std::vector<FeatureCase> motion_cases();

/// IEC 61966-2-1, of a code from 0 to 255.
double from_srgb(double code);

}  // namespace umbrix::app
