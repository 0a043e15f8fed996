// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render/pixel_samples.h"
#include "render/vec.h"

namespace umbrix::render {

/// A right-handed frame of unit vectors whose third is `normal`.
struct Frame3 {
  explicit Frame3(const Vec3& normal);

  Vec3 to_world(const Vec3& v) const { return v.x * x + v.y * y + v.z * z; }

  Vec3 x, y, z;
};

/// A direction around +z with the density cosine / pi.
Vec3 cosine_hemisphere(const SamplePoint& u);

}  // namespace umbrix::render
