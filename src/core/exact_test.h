// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/double_test.h"
#include "core/math.h"
#include "umbrix/ray.h"

namespace umbrix::detail {

/// The parameters of a hit that has been decided.
struct HitParameters {
  double t, u, v;
};

/// Does the ray hit the triangle, decided in integers? Needs finite values; the interval may be infinite.
bool hits_exactly(const Ray& ray, const Triangle& triangle) noexcept;

/// The sign of t(a) - t(b) for two triangles that the ray's line hits.
int compare_t_exactly(const Ray& ray, const Triangle& a, const Triangle& b) noexcept;

/// Parameters of a hit from the exact values, for hits too close to edge-on for double.
HitParameters exact_parameters(const Ray& ray, const Triangle& triangle) noexcept;

/// Has the triangle no area?
bool is_degenerate(const Triangle& triangle) noexcept;

}  // namespace umbrix::detail
