// SPDX-License-Identifier: Apache-2.0
// The point comes from the triangle's exact vertices, not from origin + t * direction (after Pharr, Jakob & Humphreys
// 2023, section 6.8.5): any barycentric coordinates give a point of the triangle's plane, so their own error moves it
// only within the plane. What is left is the rounding of the double arithmetic here, and once to float, where
// shadow rays start.
#include "render/surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/materials/material_at.h"
#include "render/materials/normal_map.h"

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

/// A triangle's normal in its mesh's space, of any length.
Vec3 local_normal(const MeshPoint& at) {
  const std::array<std::uint32_t, 3>& indices = at.mesh.triangles[at.triangle];
  Vec3 p[3];
  for (std::size_t k = 0; k < 3; ++k) p[k] = to_vec3(at.mesh.positions[indices[k]]);
  return glm::cross(p[1] - p[0], p[2] - p[0]);
}

bool has_direction(const Vec3& v) {
  const double length = glm::length(v);
  return length > 0 && std::isfinite(length);
}

/// The interpolated normal as a normal texture turns it, or the geometric one where there is none worth the name.
Vec3 shading_normal(const WorldMesh& mesh, const MeshPoint& at, const Vec3& geometric) {
  const io::Transform& to_world = at.file.instances[mesh.instance].to_world;
  Vec3 local(0), normal = geometric;
  if (!at.mesh.normals.empty()) {
    double blended[3];
    at.blend(at.mesh.normals, blended);
    local = Vec3(blended[0], blended[1], blended[2]);
    const Vec3 turned = transform_normal(mesh, to_world, local);
    if (has_direction(turned)) normal = glm::normalize(turned);
  }
  if (at.material().normal_texture.texture < 0) return normal;
  const Vec3 mapped = mapped_normal(at, to_world, has_direction(local) ? local : local_normal(at), normal);
  return has_direction(mapped) ? glm::normalize(mapped) : normal;
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

void find_surface(const World& world, const Ray& ray, const Hit& hit, Surface& surface) {
  const WorldMesh& mesh = world.meshes[hit.primitive.mesh];
  const std::array<std::uint32_t, 3>& indices = mesh.mesh->triangles[hit.primitive.triangle];
  Corners corners;
  for (std::size_t i = 0; i < 3; ++i) corners.p[i] = to_vec3(mesh.position(indices[i]));
  const Vec3 normal = glm::cross(corners.p[1] - corners.p[0], corners.p[2] - corners.p[0]);
  const double area = glm::length(normal);

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
  const MeshPoint at = {*world.file, *mesh.mesh, hit.primitive.triangle, {b.b[0], b.b[1], b.b[2]}};
  Vec3 shading = shading_normal(mesh, at, geometric);
  const bool behind = glm::dot(geometric, surface.to_viewer) < 0;
  if (behind) {
    geometric = -geometric;
    shading = -shading;
  }
  surface.geometric_normal = geometric;
  surface.shading_normal = shading;
  const MaterialPoint material = material_at(at);
  surface.bsdf = material.bsdf;
  const bool emits = !behind || at.material().double_sided || at.material().unlit;
  surface.emission = emits ? material.emission : Rgb(0);
  surface.origin = origin_before(surface);
}

}  // namespace umbrix::render
