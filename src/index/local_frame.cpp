// SPDX-License-Identifier: Apache-2.0
#include "index/local_frame.h"

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace umbrix::detail {
namespace {

/// Products of three such numbers, and of two with a float, are far from the ends of double.
constexpr double kLeast = 0x1p-300, kMost = 0x1p300;
/// Of floats that are sure not to overflow.
constexpr double kMostPlaced = 0x1p126;
/// For the rounding of what bounds are computed by.
constexpr double kSlack = 1.01;

bool is_in_range(double x) { return x == 0 || (std::abs(x) >= kLeast && std::abs(x) <= kMost); }

/// The frame's inverse; false if there is none. Its own error is no matter: the residual is measured.
bool invert(const double (&m)[3][4], double (&inverse)[3][3]) {
  glm::dmat3 columns;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      if (!is_in_range(m[row][column])) return false;
      columns[column][row] = m[row][column];
    }
  const glm::dmat3 inverted = glm::inverse(columns);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) inverse[row][column] = inverted[column][row];
  return true;
}

}  // namespace

bool make_local_frame(const double (&m)[3][4], const Box& bounds, LocalFrame& out) noexcept {
  LocalFrame frame{};
  if (!invert(m, frame.inverse)) return false;
  const DVec3 most = glm::max(glm::abs(DVec3(bounds.lower)), glm::abs(DVec3(bounds.upper)));

  // How far a vertex is from where real arithmetic would place it.
  double error[3];
  double farthest = 0;
  for (int j = 0; j < 3; ++j) {
    frame.translation[j] = m[j][3];
    const double sum =
        std::abs(m[j][0]) * most.x + std::abs(m[j][1]) * most.y + std::abs(m[j][2]) * most.z + std::abs(m[j][3]);
    if (!(sum <= kMostPlaced)) return false;
    error[j] = kSlack * 0x1p-24 * sum + 0x1p-149;
    farthest = std::max(farthest, kSlack * sum + 0x1p-149);
  }

  const double use = 0x1p-4 * static_cast<double>(bounds.largest_extent());
  for (int k = 0; k < 3; ++k) {
    double norm = 0, growth = 0;
    for (int j = 0; j < 3; ++j) {
      norm += std::abs(frame.inverse[k][j]);
      growth += std::abs(frame.inverse[k][j]) * error[j];
      double product = k == j ? -1 : 0, terms = 1;
      for (int i = 0; i < 3; ++i) {
        product += frame.inverse[k][i] * m[i][j];
        terms += std::abs(frame.inverse[k][i] * m[i][j]);
      }
      growth += (std::abs(product) + 0x1p-50 * terms) * most[j];
    }
    frame.norm[k] = kSlack * norm;
    // The translation is no larger than the farthest vertex's sum.
    frame.growth[k] = kSlack * (growth + 2 * LocalFrame::kOriginGrowth * frame.norm[k] * farthest + 0x1p-49 * most[k]);
    if (!(norm >= kLeast && norm <= kMost && frame.growth[k] <= use)) return false;
  }
  out = frame;
  return true;
}

LocalFrame scaled_frame(int exponent) noexcept {
  LocalFrame frame{};
  for (int k = 0; k < 3; ++k) {
    frame.inverse[k][k] = frame.norm[k] = std::ldexp(1.0, exponent);
    frame.growth[k] = 4 * LocalFrame::kOriginGrowth;
  }
  return frame;
}

}  // namespace umbrix::detail
