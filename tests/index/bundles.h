// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>
#include <vector>

#include "small_scene.h"
#include "umbrix/ray.h"

namespace umbrix::detail {

/// `each` rays from each of neighbouring points to a box around the light that is `reach` wide on either side.
inline std::vector<Ray> bundles(std::size_t points, std::size_t each, float spread, std::uint32_t seed,
                                float reach = 0.1f) {
  std::mt19937 random(seed);
  const Vec3 light(0.3f, 0.9f, -0.2f);
  std::vector<Ray> rays;
  Vec3 middle(0);
  for (std::size_t i = 0; i < points; ++i) {
    if (i % 40 == 0) middle = random_point(random);
    const Vec3 from = middle + spread * random_point(random);
    for (std::size_t k = 0; k < each; ++k) {
      const Vec3 d = light + reach * random_point(random) - from;
      rays.push_back({{from.x, from.y, from.z}, 0, {d.x, d.y, d.z}, 1});
    }
  }
  return rays;
}

}  // namespace umbrix::detail
