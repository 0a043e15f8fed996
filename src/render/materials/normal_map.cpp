// SPDX-License-Identifier: Apache-2.0
// glTF 2.0 sections 3.7.2.1 and 3.9.3: x of the texture is to the image's right, y to its top (coordinates' v points
// down), z off the surface. Without tangents in the file they follow the texture coordinates, per triangle and at right
// angles to the interpolated normal, as MikkTSpace (Mikkelsen 2008) has them before it averages at vertices.
#include "render/materials/normal_map.h"

#include <cmath>

#include "render/materials/texture.h"

namespace umbrix::render {
namespace {

/// Directions of the image's right and top on the surface, in the mesh's space.
struct TangentFrame {
  Vec3 right{0};
  Vec3 top{0};
};

TangentFrame frame_of_tangents(const MeshPoint& point, const Vec3& normal) {
  double tangent[4];
  point.blend(point.mesh.tangents, tangent);
  const Vec3 right(tangent[0], tangent[1], tangent[2]);
  return {right, glm::cross(normal, right) * (tangent[3] < 0 ? -1.0 : 1.0)};
}

/// Solves for how the surface's point moves with the image's u and v.
TangentFrame frame_of_coordinates(const MeshPoint& point, const io::TextureUse& use, const Vec3& normal) {
  const auto& corners = point.mesh.triangles[point.triangle];
  const auto& texcoords = point.mesh.texcoord_sets[use.texcoord];
  Vec3 edge[2];
  double du[2], dv[2];
  for (std::size_t i = 0; i < 2; ++i) {
    edge[i] = to_vec3(point.mesh.positions[corners[i + 1]]) - to_vec3(point.mesh.positions[corners[0]]);
    const double s = static_cast<double>(texcoords[corners[i + 1]][0]) - static_cast<double>(texcoords[corners[0]][0]);
    const double t = static_cast<double>(texcoords[corners[i + 1]][1]) - static_cast<double>(texcoords[corners[0]][1]);
    du[i] = use.transform[0][0] * s + use.transform[0][1] * t;
    dv[i] = use.transform[1][0] * s + use.transform[1][1] * t;
  }
  const double determinant = du[0] * dv[1] - du[1] * dv[0];
  if (determinant == 0) return {};
  const double turn = determinant < 0 ? -1 : 1;
  Vec3 right = turn * (dv[1] * edge[0] - dv[0] * edge[1]);
  right -= normal * (glm::dot(normal, right) / glm::dot(normal, normal));
  const double length = glm::length(right);
  if (!(length > 0)) return {};
  right /= length;
  // With v down, an image that is not mirrored turns the other way than the normal's right-handed frame.
  return {right, glm::cross(normal, right) * -turn};
}

Vec3 transform_direction(const io::Transform& m, const Vec3& d) {
  return Vec3(m[0][0] * d.x + m[0][1] * d.y + m[0][2] * d.z, m[1][0] * d.x + m[1][1] * d.y + m[1][2] * d.z,
              m[2][0] * d.x + m[2][1] * d.y + m[2][2] * d.z);
}

Vec3 unit_or_zero(const Vec3& v) {
  const double length = glm::length(v);
  return length > 0 && std::isfinite(length) ? v / length : Vec3(0);
}

}  // namespace

Vec3 mapped_normal(const MeshPoint& point, const io::Transform& to_world, const Vec3& normal, const Vec3& turned) {
  const io::Material& material = point.material();
  const io::TextureUse& use = material.normal_texture;
  if (!has_texture(point.file, point.mesh, use)) return Vec3(0);
  const Vec3 local = unit_or_zero(normal);
  const TangentFrame frame =
      point.mesh.tangents.empty() ? frame_of_coordinates(point, use, local) : frame_of_tangents(point, local);
  const Vec3 right = unit_or_zero(transform_direction(to_world, frame.right));
  const Vec3 top = unit_or_zero(transform_direction(to_world, frame.top));
  if (right == Vec3(0) || top == Vec3(0)) return Vec3(0);
  const Vec3 texel = 2.0 * texture_at(point, use, Transfer::linear).color - 1.0;
  const double scale = static_cast<double>(material.normal_scale);
  return scale * texel.x * right + scale * texel.y * top + texel.z * unit_or_zero(turned);
}

}  // namespace umbrix::render
