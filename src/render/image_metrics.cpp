// SPDX-License-Identifier: Apache-2.0
#include "render/image_metrics.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace umbrix::render {
namespace {

constexpr double kTrimmed = 0.001;         // of the pixels
constexpr double kRelativeEpsilon = 0.01;  // of mean(R)^2: keeps black pixels from ruling relMSE

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double mean_without_largest(std::vector<double> values) {
  const auto kept = values.size() - static_cast<std::size_t>(kTrimmed * static_cast<double>(values.size()));
  const auto end = values.begin() + static_cast<std::ptrdiff_t>(kept);
  std::nth_element(values.begin(), end - 1, values.end());
  return std::accumulate(values.begin(), end, 0.0) / static_cast<double>(kept);
}

/// Both measures of differences from a reference.
ImageError measure(const std::vector<double>& difference, const RgbValues& reference) {
  const double average = mean(reference), epsilon = kRelativeEpsilon * average * average;
  std::vector<double> squared(difference.size() / 3), relative(squared.size());
  for (std::size_t pixel = 0; pixel < squared.size(); ++pixel) {
    for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
      const double square = difference[i] * difference[i];
      squared[pixel] += square / 3;
      if (square > 0) relative[pixel] += square / (reference[i] * reference[i] + epsilon) / 3;
    }
  }
  return {std::sqrt(mean(squared)), std::sqrt(mean_without_largest(squared)), mean(relative),
          mean_without_largest(relative), mean(difference)};
}

}  // namespace

RgbValues rgb_of(const io::Image& image) {
  const std::size_t channels = image.channels.size();
  RgbValues rgb;
  rgb.reserve(image.pixels.size() / channels * 3);
  for (std::size_t i = 0; i < image.pixels.size(); i += channels) {
    for (std::size_t k = 0; k < 3; ++k) rgb.push_back(double{image.pixels[i + k]});
  }
  return rgb;
}

ImageError image_error(const RgbValues& image, const RgbValues& reference) {
  std::vector<double> difference(image.size());
  std::transform(image.begin(), image.end(), reference.begin(), difference.begin(), std::minus<>());
  return measure(difference, reference);
}

ImageError noise_of_mean(const RgbValues& a, const RgbValues& b) {
  // Half the difference has the variance of the mean, of whose expectation it has none.
  RgbValues half(a.size()), middle(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    half[i] = (a[i] - b[i]) / 2;
    middle[i] = (a[i] + b[i]) / 2;
  }
  ImageError noise = measure(half, middle);
  noise.mean_difference = noise.rmse / std::sqrt(static_cast<double>(a.size()) / 3);
  return noise;
}

}  // namespace umbrix::render
