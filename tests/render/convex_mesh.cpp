// SPDX-License-Identifier: Apache-2.0
#include "convex_mesh.h"

#include <cmath>

namespace umbrix::render {
namespace {

/// Positive if d sees a, b, c counter-clockwise.
std::int64_t orientation(const Int3& a, const Int3& b, const Int3& c, const Int3& d) {
  Int3 u, v, w;
  for (std::size_t k = 0; k < 3; ++k) {
    u[k] = b[k] - a[k];
    v[k] = c[k] - a[k];
    w[k] = d[k] - a[k];
  }
  return w[0] * (u[1] * v[2] - u[2] * v[1]) + w[1] * (u[2] * v[0] - u[0] * v[2]) + w[2] * (u[0] * v[1] - u[1] * v[0]);
}

}  // namespace

bool ConvexMesh::in_front(std::size_t triangle, const Int3& point) const {
  const auto& [i, j, k] = triangles[triangle];
  return orientation(points[i], points[j], points[k], point) > 0;
}

io::Mesh ConvexMesh::placed(const Int3& base, int exponent) const {
  io::Mesh mesh;
  for (const Int3& point : points) {
    io::Float3 position;
    for (std::size_t k = 0; k < 3; ++k) position[k] = std::ldexp(static_cast<float>(base[k] + point[k]), exponent);
    mesh.positions.push_back(position);
  }
  mesh.triangles = triangles;
  return mesh;
}

ConvexMesh convex_hull(const std::vector<Int3>& points) {
  ConvexMesh mesh;
  mesh.points = points;
  const auto count = static_cast<std::uint32_t>(points.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    for (std::uint32_t j = i + 1; j < count; ++j) {
      for (std::uint32_t k = j + 1; k < count; ++k) {
        bool any_front = false, any_behind = false;
        for (const Int3& point : points) {
          const std::int64_t side = orientation(points[i], points[j], points[k], point);
          any_front |= side > 0;
          any_behind |= side < 0;
        }
        if (any_front == any_behind) continue;  // inside the hull, or without area
        if (any_front) {
          mesh.triangles.push_back({i, k, j});
        } else {
          mesh.triangles.push_back({i, j, k});
        }
      }
    }
  }
  return mesh;
}

}  // namespace umbrix::render
