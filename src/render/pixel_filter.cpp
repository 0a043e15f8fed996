// SPDX-License-Identifier: Apache-2.0
#include "render/pixel_filter.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "render/vec.h"

namespace umbrix::render {
namespace {

double radius_of(PixelFilter filter) {
  if (filter == PixelFilter::box) return 0.5;
  return filter == PixelFilter::triangle ? 1 : 1.5;
}

/// Harris 1978, "On the Use of Windows for Harmonic Analysis with the Discrete Fourier Transform": four terms, -92 dB.
double blackman_harris(double x) {
  const double phase = kPi * (1 + x);
  return 0.35875 - 0.48829 * std::cos(phase) + 0.14128 * std::cos(2 * phase) - 0.01168 * std::cos(3 * phase);
}

/// At `x` of the radius, of any scale.
double weight(PixelFilter filter, double x) {
  switch (filter) {
    case PixelFilter::box:
      return 1;
    case PixelFilter::triangle:
      return 1 - x;
    case PixelFilter::gaussian:
      return std::exp(-2 * 1.5 * 1.5 * x * x) - std::exp(-2 * 1.5 * 1.5);
    case PixelFilter::blackman_harris:
      return blackman_harris(x);
  }
  return 0;
}

}  // namespace

FilterSampler::FilterSampler(PixelFilter filter) {
  constexpr std::size_t kParts = 16 * kSteps;
  const auto middle = [](std::size_t part) { return (static_cast<double>(part) + 0.5) / kParts; };
  double total = 0;
  for (std::size_t part = 0; part < kParts; ++part) total += weight(filter, middle(part));
  double below = 0;
  std::size_t next = 1;
  for (std::size_t part = 0; part < kParts; ++part) {
    const double here = weight(filter, middle(part));
    for (; next < kSteps && below + here > total * static_cast<double>(next) / kSteps; ++next) {
      const double rest = (total * static_cast<double>(next) / kSteps - below) / here;
      quantiles_[next] = radius_of(filter) * (static_cast<double>(part) + rest) / kParts;
    }
    below += here;
  }
  quantiles_[kSteps] = radius_of(filter);
}

double FilterSampler::offset(double u) const {
  const double scaled = std::abs(2 * u - 1) * kSteps;
  const auto below = std::min(static_cast<std::size_t>(scaled), kSteps - 1);
  const double distance = glm::mix(quantiles_[below], quantiles_[below + 1], scaled - static_cast<double>(below));
  return std::copysign(distance, u - 0.5);
}

}  // namespace umbrix::render
