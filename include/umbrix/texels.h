// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "umbrix/export.h"

namespace umbrix {

/// What is beyond an image's edges.
enum class Wrap { repeat, clamp, mirror };

/// How an image is read between its texels.
struct TexelSampler {
  Wrap wrap_u = Wrap::repeat;
  Wrap wrap_v = Wrap::repeat;
  bool nearest = false;  ///< the texel that holds the point; else linear between the four around it
};

/// The texels around a point and how near it is to the later ones.
struct TexelQuad {
  std::uint32_t x[2];
  std::uint32_t y[2];
  double fx;
  double fy;

  /// Blends what `texel(x, y)` gives, of any type with differences, sums and multiples. Exact where all are equal.
  template <class Texel>
  auto blend(Texel&& texel) const {
    const auto between = [](const auto& a, const auto& b, double f) { return a + (b - a) * f; };
    const auto upper = between(texel(x[0], y[0]), texel(x[1], y[0]), fx);
    return fy == 0 ? upper : between(upper, between(texel(x[0], y[1]), texel(x[1], y[1]), fx), fy);
  }
};

/// For coordinates that run from (0, 0) at the image's upper left corner to (1, 1); `width` and `height` at least 1.
/// What is no number counts as 0. Thread-safe.
UMBRIX_API TexelQuad texels_at(const TexelSampler& sampler, std::uint32_t width, std::uint32_t height, double u,
                               double v) noexcept;

}  // namespace umbrix
