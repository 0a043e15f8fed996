// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "umbrix/io/image_file.h"

namespace umbrix::render {

/// R, G, B of each pixel, linear.
using RgbValues = std::vector<double>;

/// The first three channels of a rendered image.
RgbValues rgb_of(const io::Image& image);

/// How far an image is from its reference.
struct ImageError {
  double rmse = 0;             ///< root of the mean squared difference over pixels and channels
  double rmse_trimmed = 0;     ///< without the 0.1 % of the pixels that differ most
  double relmse = 0;           ///< mean of (I - R)^2 / (R^2 + 0.01 mean(R)^2)
  double relmse_trimmed = 0;   ///< without the 0.1 % of the pixels that differ most by that measure
  double mean_difference = 0;  ///< of I - R: the bias, but for noise
};

/// Of two images of the same size, which is not 0.
ImageError image_error(const RgbValues& image, const RgbValues& reference);

/// The noise of the mean of two independent images, estimated from half their difference: ImageError's measures, with
/// mean_difference the standard error of the mean over all pixels, as if their noise were independent.
ImageError noise_of_mean(const RgbValues& a, const RgbValues& b);

}  // namespace umbrix::render
