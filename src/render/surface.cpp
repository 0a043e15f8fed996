// SPDX-License-Identifier: Apache-2.0
// The point comes from the triangle's exact vertices, not from origin + t * direction (after Pharr, Jakob & Humphreys
// 2023, section 6.8.5): any barycentric coordinates give a point of the triangle's plane, so their own error moves it
// only within the plane. What is left is rounding: of the double arithmetic, and once to float.
#include "render/surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace umbrix::render {
namespace {

struct Barycentrics {
  double b0, b1, b2;
};

/// Rounding to float may have left u + v above 1: stay within the triangle.
Barycentrics barycentrics(const Hit& hit) {
  const double b1 = std::clamp(double{hit.u}, 0.0, 1.0);
  const double b2 = std::clamp(double{hit.v}, 0.0, 1.0 - b1);
  return {1 - b1 - b2, b1, b2};
}

/// Transforms normals by the inverse transpose. Its positive multiple, the cofactors times the sign of the
/// determinant, needs no division, so a flattened mesh has a normal as well.
Vec3 transform_normal(const WorldMesh& mesh, const io::Transform& m, const Vec3& n) {
  const Vec3 row0(m[0][0], m[0][1], m[0][2]), row1(m[1][0], m[1][1], m[1][2]), row2(m[2][0], m[2][1], m[2][2]);
  const Vec3 turned(glm::dot(glm::cross(row1, row2), n), glm::dot(glm::cross(row2, row0), n),
                    glm::dot(glm::cross(row0, row1), n));
  return mesh.mirrored ? -turned : turned;
}

/// The interpolated normal, or the geometric one where there is none worth the name.
Vec3 shading_normal(const World& world, const WorldMesh& mesh, const std::array<std::uint32_t, 3>& corners,
                    const Barycentrics& b, const Vec3& geometric) {
  const std::vector<io::Float3>& normals = mesh.mesh->normals;
  if (normals.empty()) return geometric;
  const Vec3 local =
      b.b0 * to_vec3(normals[corners[0]]) + b.b1 * to_vec3(normals[corners[1]]) + b.b2 * to_vec3(normals[corners[2]]);
  const Vec3 normal = transform_normal(mesh, world.file->instances[mesh.instance].to_world, local);
  const double length = glm::length(normal);
  return length > 0 && std::isfinite(length) ? normal / length : geometric;
}

}  // namespace

Surface surface_at(const World& world, const Ray& ray, const Hit& hit) {
  const WorldMesh& mesh = world.meshes[hit.primitive.mesh];
  const std::array<std::uint32_t, 3>& corners = mesh.mesh->triangles[hit.primitive.triangle];
  const Vec3 p0 = to_vec3(mesh.positions[corners[0]]);
  const Vec3 p1 = to_vec3(mesh.positions[corners[1]]);
  const Vec3 p2 = to_vec3(mesh.positions[corners[2]]);
  const Barycentrics b = barycentrics(hit);

  Surface surface;
  surface.material = &world.file->materials[mesh.mesh->material];
  surface.primitive = hit.primitive;
  surface.to_viewer = -glm::normalize(Vec3(ray.direction[0], ray.direction[1], ray.direction[2]));

  // Half a unit in the last place for the float, and 8 roundings (gamma_7 and a margin) for the double sums.
  const Vec3 point = b.b0 * p0 + b.b1 * p1 + b.b2 * p2;
  const Vec3 magnitude = b.b0 * glm::abs(p0) + b.b1 * glm::abs(p1) + b.b2 * glm::abs(p2);
  const Vec3 error = glm::abs(point) * 0x1p-24 + magnitude * 0x1p-49;
  for (int axis = 0; axis < 3; ++axis) {
    surface.point[axis] = static_cast<float>(point[axis]);
    surface.point_error[axis] = std::nextafter(static_cast<float>(error[axis]), std::numeric_limits<float>::infinity());
  }

  // Turn both normals to the viewer: the geometric one decides which side the ray came from.
  Vec3 geometric = glm::normalize(glm::cross(p1 - p0, p2 - p0));
  if (mesh.mirrored) geometric = -geometric;
  Vec3 shading = shading_normal(world, mesh, corners, b, geometric);
  const bool behind = glm::dot(geometric, surface.to_viewer) < 0;
  if (behind) {
    geometric = -geometric;
    shading = -shading;
  }
  surface.geometric_normal = geometric;
  surface.shading_normal = shading;
  surface.emits = !behind || surface.material->double_sided;
  float normal[3];
  store(geometric, normal);
  offset_origin(surface.point, surface.point_error, normal, normal, surface.origin);
  return surface;
}

}  // namespace umbrix::render
