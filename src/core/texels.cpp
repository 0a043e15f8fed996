// SPDX-License-Identifier: Apache-2.0
#include "umbrix/texels.h"

#include <algorithm>
#include <cmath>

namespace umbrix {
namespace {

/// Brings a coordinate to [0, 1].
double wrapped(Wrap wrap, double t) noexcept {
  if (!std::isfinite(t)) return 0;
  switch (wrap) {
    case Wrap::clamp:
      return std::clamp(t, 0.0, 1.0);
    case Wrap::mirror: {
      const double within = t - 2 * std::floor(t / 2);
      return within > 1 ? 2 - within : within;
    }
    default:
      return t - std::floor(t);
  }
}

/// The two texels of an axis around a point, and the point's place between their centres.
void find_pair(Wrap wrap, bool nearest, std::uint32_t size, double t, std::uint32_t pair[2],
               double& fraction) noexcept {
  const double place = wrapped(wrap, t) * size;
  if (nearest) {
    pair[0] = pair[1] = std::min(static_cast<std::uint32_t>(place), size - 1);
    fraction = 0;
    return;
  }
  const double below = std::floor(place - 0.5);
  fraction = place - 0.5 - below;
  // Beyond the edge is the other side, or, for both clamped and mirrored images, the edge again.
  const std::uint32_t before_first = wrap == Wrap::repeat ? size - 1 : 0,
                      after_last = wrap == Wrap::repeat ? 0 : size - 1;
  pair[0] = below < 0 ? before_first : static_cast<std::uint32_t>(below);
  pair[1] = below + 1 >= size ? after_last : static_cast<std::uint32_t>(below + 1);
}

}  // namespace

TexelQuad texels_at(const TexelSampler& sampler, std::uint32_t width, std::uint32_t height, double u,
                    double v) noexcept {
  TexelQuad quad;
  find_pair(sampler.wrap_u, sampler.nearest, width, u, quad.x, quad.fx);
  find_pair(sampler.wrap_v, sampler.nearest, height, v, quad.y, quad.fy);
  return quad;
}

}  // namespace umbrix
