// SPDX-License-Identifier: Apache-2.0
#include "core/mesh_triangles.h"

#include <cstdint>
#include <string>

namespace umbrix::detail {
namespace {

Vec3 vertex(const MeshView& mesh, std::size_t triangle, std::size_t corner) noexcept {
  const std::size_t number = vertex_of(mesh.indices, mesh.index_stride, triangle, corner);
  const float* const p =
      reinterpret_cast<const float*>(reinterpret_cast<const char*>(mesh.vertices) + number * mesh.vertex_stride);
  return {p[0], p[1], p[2]};
}

}  // namespace

Triangle triangle_of(const MeshView& mesh, std::size_t i) noexcept {
  return {{vertex(mesh, i, 0), vertex(mesh, i, 1), vertex(mesh, i, 2)}};
}

std::vector<Triangle> triangles_of(const MeshView& mesh) {
  std::vector<Triangle> triangles(mesh.triangle_count);
  for (std::size_t i = 0; i < triangles.size(); ++i) triangles[i] = triangle_of(mesh, i);
  return triangles;
}

Status check(const MeshView& mesh) {
  if (mesh.triangle_count == 0) return {};
  if (!mesh.vertices || mesh.vertex_count == 0) return {StatusCode::invalid_argument, "mesh: no vertices"};
  if (mesh.vertex_stride < 12 || mesh.vertex_stride % 4 != 0)
    return {StatusCode::invalid_argument, "mesh: vertex_stride must be a multiple of 4 and at least 12"};
  if (mesh.indices && (mesh.index_stride < 12 || mesh.index_stride % 4 != 0))
    return {StatusCode::invalid_argument, "mesh: index_stride must be a multiple of 4 and at least 12"};
  if (reinterpret_cast<std::uintptr_t>(mesh.vertices) % 4 != 0 ||
      reinterpret_cast<std::uintptr_t>(mesh.indices) % 4 != 0)
    return {StatusCode::invalid_argument, "mesh: vertices and indices must be aligned to 4 bytes"};
  if (!mesh.indices && mesh.vertex_count / 3 < mesh.triangle_count)
    return {StatusCode::invalid_argument, "mesh: fewer than three vertices a triangle"};
  for (std::size_t i = 0; i < mesh.triangle_count && mesh.indices; ++i) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t index = vertex_of(mesh.indices, mesh.index_stride, i, corner);
      if (index >= mesh.vertex_count)
        return {StatusCode::invalid_argument, "mesh: triangle " + std::to_string(i) + " uses vertex " +
                                                  std::to_string(index) + " of " + std::to_string(mesh.vertex_count)};
    }
  }
  return {};
}

}  // namespace umbrix::detail
