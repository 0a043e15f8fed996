// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace umbrix::render {

/// Shading computes in double: next to tracing it costs little, and one rounding to float at the end is all that
/// a pixel sees.
using Vec3 = glm::dvec3;

/// Linear Rec.709 colour.
using Rgb = glm::dvec3;

constexpr double kPi = 3.14159265358979323846;

/// ITU-R BT.709.
inline double luminance(const Rgb& color) { return 0.2126 * color.r + 0.7152 * color.g + 0.0722 * color.b; }

template <typename T>
Vec3 to_vec3(const std::array<T, 3>& a) {
  return Vec3(a[0], a[1], a[2]);
}

inline Vec3 load(const float in[3]) { return Vec3(in[0], in[1], in[2]); }

/// Rounds to float, into any three consecutive floats.
inline void store(const Vec3& v, float out[3]) {
  for (int axis = 0; axis < 3; ++axis) out[axis] = static_cast<float>(v[axis]);
}

}  // namespace umbrix::render
