// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace umbrix {

/// The open segment origin + t * direction, tmin < t < tmax. The direction need not be normalised;
/// either end may be infinite. A ray with a NaN, a non-finite origin or direction, a zero direction
/// or an empty interval hits nothing.
struct Ray {
  float origin[3];
  float tmin;
  float direction[3];
  float tmax;
};
static_assert(sizeof(Ray) == 32, "hosts hand over arrays of 32-byte rays");

/// Borrowed rays, `stride` bytes apart (at least sizeof(Ray) apart; alignment of float suffices).
struct RaySpan {
  const Ray* data = nullptr;
  std::size_t count = 0;
  std::size_t stride = sizeof(Ray);

  const Ray& operator[](std::size_t i) const noexcept {
    return *reinterpret_cast<const Ray*>(reinterpret_cast<const char*>(data) + i * stride);
  }
};

/// Names a triangle: the mesh in the order of Scene::add, and the triangle within it.
struct Primitive {
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
  std::uint32_t mesh = kNone;
  std::uint32_t triangle = kNone;
};

/// The closest hit. The point is (1-u-v) v0 + u v1 + v v2; t, u, v are the correctly decided hit's
/// parameters, rounded from double. `primitive.mesh == Primitive::kNone` means no hit.
struct Hit {
  float t = 0;
  float u = 0;
  float v = 0;
  Primitive primitive;

  bool valid() const noexcept { return primitive.mesh != Primitive::kNone; }
};

}  // namespace umbrix
