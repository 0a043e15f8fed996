// SPDX-License-Identifier: Apache-2.0
#include "render/pixel_filter.h"

#include <algorithm>
#include <cmath>

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

FilterSampler::FilterSampler(PixelFilter filter) : radius_(radius_of(filter)) {
  for (std::size_t i = 1; i <= kSteps; ++i) {
    sums_[i] = sums_[i - 1] + weight(filter, (static_cast<double>(i) - 0.5) / kSteps);
  }
  for (double& sum : sums_) sum /= sums_[kSteps];
}

double FilterSampler::offset(double u) const {
  const double wanted = std::abs(2 * u - 1);
  const auto above = std::upper_bound(sums_.begin() + 1, sums_.end() - 1, wanted);
  const double below = *(above - 1);
  const double steps = static_cast<double>(above - 1 - sums_.begin()) + (wanted - below) / (*above - below);
  return std::copysign(radius_ * steps / kSteps, u - 0.5);
}

}  // namespace umbrix::render
