// SPDX-License-Identifier: Apache-2.0
// Sutherland & Hodgman's (1974) polygon clipping against the six planes of a box, in double. Its rounding, about 1e-16
// of the scene, disappears in the factor of four between the tree's eps and the one that the walk needs.

#include "tree/clip.h"

#include <cmath>

namespace umbrix::detail {
namespace {

constexpr int kMaxVertices = 9;

struct Polygon {
  DVec3 vertices[kMaxVertices];
  int count = 0;
};

/// Keeps the part with sign * (p[axis] - plane) >= 0.
void clip(const Polygon& in, int axis, double plane, double sign, Polygon& out) noexcept {
  out.count = 0;
  for (int i = 0; i < in.count; ++i) {
    const DVec3& a = in.vertices[i];
    const DVec3& b = in.vertices[i + 1 == in.count ? 0 : i + 1];
    const double da = sign * (a[axis] - plane);
    const double db = sign * (b[axis] - plane);
    if (da >= 0) out.vertices[out.count++] = a;
    if ((da > 0 && db < 0) || (da < 0 && db > 0)) {
      DVec3 p = a + (b - a) * (da / (da - db));
      p[axis] = plane;
      out.vertices[out.count++] = p;
    }
  }
}

/// At least one unit in the last place below or above: cheaper than nextafter, which is a call.
float below(float x) noexcept { return x - (std::abs(x) * 0x1p-23f + std::numeric_limits<float>::min()); }
float above(float x) noexcept { return x + (std::abs(x) * 0x1p-23f + std::numeric_limits<float>::min()); }

float round_down(double x) noexcept {
  const float f = static_cast<float>(x);
  return static_cast<double>(f) > x ? below(f) : f;
}

float round_up(double x) noexcept {
  const float f = static_cast<float>(x);
  return static_cast<double>(f) < x ? above(f) : f;
}

/// The part of the triangle inside the cell grown by `margin`; false if there is none.
bool clip_to_cell(const Triangle& triangle, const Box& cell, double margin, Polygon& polygon) noexcept {
  Polygon other;
  for (const Vec3& v : triangle.v) polygon.vertices[polygon.count++] = DVec3(v);
  for (int axis = 0; axis < 3; ++axis) {
    const double lower = static_cast<double>(cell.lower[axis]) - margin;
    const double upper = static_cast<double>(cell.upper[axis]) + margin;
    double low = INFINITY, high = -INFINITY;
    for (int i = 0; i < polygon.count; ++i) {
      low = std::min(low, polygon.vertices[i][axis]);
      high = std::max(high, polygon.vertices[i][axis]);
    }
    if (low > upper || high < lower) return false;
    if (low < lower) {
      clip(polygon, axis, lower, 1, other);
      std::swap(polygon, other);
    }
    if (high > upper) {
      clip(polygon, axis, upper, -1, other);
      std::swap(polygon, other);
    }
  }
  return true;
}

}  // namespace

Box clipped_bounds(const Triangle& triangle, const Box& cell, double margin) noexcept {
  Polygon polygon;
  if (!clip_to_cell(triangle, cell, margin, polygon)) return {};
  Box box;
  for (int i = 0; i < polygon.count; ++i) {
    const DVec3& p = polygon.vertices[i];
    box.extend(Vec3(round_down(p.x), round_down(p.y), round_down(p.z)));
    box.extend(Vec3(round_up(p.x), round_up(p.y), round_up(p.z)));
  }
  return box;
}

double clipped_area(const Triangle& triangle, const Box& cell) noexcept {
  Polygon polygon;
  if (!clip_to_cell(triangle, cell, 0, polygon)) return 0;
  DVec3 twice(0);
  for (int i = 2; i < polygon.count; ++i)
    twice += glm::cross(polygon.vertices[i - 1] - polygon.vertices[0], polygon.vertices[i] - polygon.vertices[0]);
  return glm::length(twice) / 2;
}

float down_by(float x, float by) noexcept { return below(x - by); }
float up_by(float x, float by) noexcept { return above(x + by); }

Box grown(const Box& box, float by) noexcept {
  Box result;
  for (int axis = 0; axis < 3; ++axis) {
    result.lower[axis] = down_by(box.lower[axis], by);
    result.upper[axis] = up_by(box.upper[axis], by);
  }
  return result;
}

}  // namespace umbrix::detail
