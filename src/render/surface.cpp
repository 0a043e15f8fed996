// SPDX-License-Identifier: Apache-2.0
// The point comes from the triangle's exact vertices, not from origin + t * direction (after Pharr, Jakob & Humphreys
// 2023, section 6.8.5): any barycentric coordinates give a point of the triangle's plane, so their own error moves it
// only within the plane. What is left is the rounding of the double arithmetic here, and once to float, where
// shadow rays start.
#include "render/surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace umbrix::render {
namespace {

/// A point's least distance from its triangle's edges, in units of 2^-23 of its largest coordinate. With 2, closed
/// meshes whose faces meet at right angles let no light in (tests/render/self_shadow_test); 4 also serves sharper
/// edges.
constexpr double kEdgeMargin = 4;

struct Barycentrics {
  double b[3];

  std::size_t largest() const { return static_cast<std::size_t>(std::max_element(b, b + 3) - b); }
};

/// A triangle's exact vertices.
struct Corners {
  Vec3 p[3];

  /// From the next corner to the one after it: the edge opposite to corner i.
  Vec3 opposite_edge(std::size_t i) const { return p[(i + 2) % 3] - p[(i + 1) % 3]; }
};

/// A barycentric coordinate in double: as computed, but within what rounds to the hit's float.
double refined(double computed, float rounded) {
  return std::isfinite(computed) ? std::clamp(computed, rounded * (1 - 0x1p-24), rounded * (1 + 0x1p-24)) : rounded;
}

/// The hit's barycentric coordinates in double (Moeller & Trumbore 1997): as floats they would move the point by 2^-25
/// of the triangle's size, which on a large triangle is far more than the point's own rounding.
Barycentrics barycentrics(const Corners& corners, const Ray& ray, const Hit& hit) {
  const Vec3 direction(ray.direction[0], ray.direction[1], ray.direction[2]);
  const Vec3 e1 = corners.p[1] - corners.p[0], e2 = corners.p[2] - corners.p[0];
  const Vec3 s = Vec3(ray.origin[0], ray.origin[1], ray.origin[2]) - corners.p[0];
  const Vec3 p = glm::cross(direction, e2);
  const double determinant = glm::dot(e1, p);
  const double b1 = std::clamp(refined(glm::dot(s, p) / determinant, hit.u), 0.0, 1.0);
  const double b2 = std::clamp(refined(glm::dot(direction, glm::cross(s, e1)) / determinant, hit.v), 0.0, 1 - b1);
  return {{1 - b1 - b2, b1, b2}};
}

/// Moves a point that is nearer to an edge than it can be rounded: there, rounding would put it behind the neighbour,
/// and let light into a closed mesh. `area` is twice the triangle's, `reach` the point's largest coordinate.
void keep_off_the_edges(Barycentrics& b, const Corners& corners, double area, double reach) {
  const double margin = kEdgeMargin * 0x1p-23 * reach / area;
  for (std::size_t i = 0; i < 3; ++i) {
    // Height is area over edge. A triangle that is too small for the margin keeps its points near its centre.
    b.b[i] = std::max(b.b[i], std::min(0.25, margin * glm::length(corners.opposite_edge(i))));
  }
  const std::size_t largest = b.largest();
  b.b[largest] = 1 - b.b[(largest + 1) % 3] - b.b[(largest + 2) % 3];
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
Vec3 shading_normal(const World& world, const WorldMesh& mesh, const std::array<std::uint32_t, 3>& indices,
                    const Barycentrics& b, const Vec3& geometric) {
  const std::vector<io::Float3>& normals = mesh.mesh->normals;
  if (normals.empty()) return geometric;
  Vec3 local(0);
  for (std::size_t i = 0; i < 3; ++i) local += b.b[i] * to_vec3(normals[indices[i]]);
  const Vec3 normal = transform_normal(mesh, world.file->instances[mesh.instance].to_world, local);
  const double length = glm::length(normal);
  return length > 0 && std::isfinite(length) ? normal / length : geometric;
}

/// Sums from the nearest corner on, so that any weights of the other two give a point of the plane, and a corner that
/// is far away adds no error.
void set_point(const Corners& corners, const Barycentrics& b, Surface& surface) {
  const std::size_t nearest = b.largest(), next = (nearest + 1) % 3, last = (nearest + 2) % 3;
  const Vec3 base = corners.p[nearest];
  const Vec3 along = b.b[next] * (corners.p[next] - base), across = b.b[last] * (corners.p[last] - base);
  surface.point = base + along + across;
  // gamma_4 and a margin: a difference, a product and two sums.
  surface.point_error = 0x1p-50 * (glm::abs(base) + glm::abs(along) + glm::abs(across));
}

/// The point as floats, moved off the surface by how far they are from the triangle's plane: their rounding, known to
/// the last bit, and the point's own error.
Vec3 origin_before(const Surface& surface) {
  float point[3], error[3], normal[3], origin[3];
  store(surface.point, point);
  const Vec3 bound = glm::abs(load(point) - surface.point) + surface.point_error;
  for (int axis = 0; axis < 3; ++axis) {
    error[axis] = std::nextafter(static_cast<float>(bound[axis]), std::numeric_limits<float>::infinity());
  }
  store(surface.geometric_normal, normal);
  offset_origin(point, error, normal, normal, origin);
  return load(origin);
}

}  // namespace

Surface surface_at(const World& world, const Ray& ray, const Hit& hit) {
  const WorldMesh& mesh = world.meshes[hit.primitive.mesh];
  const std::array<std::uint32_t, 3>& indices = mesh.mesh->triangles[hit.primitive.triangle];
  Corners corners;
  for (std::size_t i = 0; i < 3; ++i) corners.p[i] = to_vec3(mesh.position(indices[i]));
  const Vec3 normal = glm::cross(corners.p[1] - corners.p[0], corners.p[2] - corners.p[0]);
  const double area = glm::length(normal);

  Surface surface;
  const io::Material& material = world.file->materials[mesh.mesh->material];
  surface.bsdf = {to_vec3(material.base_color), material.metallic, material.roughness};
  surface.primitive = hit.primitive;
  surface.to_viewer = -glm::normalize(Vec3(ray.direction[0], ray.direction[1], ray.direction[2]));

  Barycentrics b = barycentrics(corners, ray, hit);
  set_point(corners, b, surface);
  const Vec3 place = glm::abs(surface.point);
  keep_off_the_edges(b, corners, area, std::max({place.x, place.y, place.z}));
  set_point(corners, b, surface);

  // Turn both normals to the viewer: the geometric one decides which side the ray came from. A needle whose area is
  // lost in double as well is seen from the front.
  Vec3 geometric = area > 0 ? normal / area : surface.to_viewer;
  if (mesh.mirrored) geometric = -geometric;
  Vec3 shading = shading_normal(world, mesh, indices, b, geometric);
  const bool behind = glm::dot(geometric, surface.to_viewer) < 0;
  if (behind) {
    geometric = -geometric;
    shading = -shading;
  }
  surface.geometric_normal = geometric;
  surface.shading_normal = shading;
  if (!behind || material.double_sided) surface.emission = to_vec3(material.emission);
  surface.origin = origin_before(surface);
  return surface;
}

}  // namespace umbrix::render
