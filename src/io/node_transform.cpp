// SPDX-License-Identifier: Apache-2.0
// Where a node is (glTF 2.0, section 3.5.3).

#include "io/node_transform.h"

#include <algorithm>
#include <cmath>

#include "io/load_error.h"

namespace umbrix::io::detail {
namespace {

glm::dmat4 from_matrix(const std::vector<double>& values, const std::string& label) {
  glm::dmat4 m;
  for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = values[static_cast<std::size_t>(i)];  // both are column-major
  constexpr double kSlack = 1e-6;
  if (std::abs(m[0][3]) > kSlack || std::abs(m[1][3]) > kSlack || std::abs(m[2][3]) > kSlack ||
      std::abs(m[3][3] - 1) > kSlack) {
    bad_input("{}: the matrix is not affine; its last row must be 0 0 0 1", label);
  }
  m[0][3] = m[1][3] = m[2][3] = 0;
  m[3][3] = 1;
  return m;
}

}  // namespace

Pose pose_of(const tinygltf::Node& node) {
  Pose pose;
  const std::vector<double>&t = node.translation, &r = node.rotation, &s = node.scale;
  if (t.size() == 3) pose.translation = {t[0], t[1], t[2]};
  if (r.size() == 4) pose.rotation = glm::dquat(r[3], r[0], r[1], r[2]);
  if (s.size() == 3) pose.scale = {s[0], s[1], s[2]};
  return pose;
}

glm::dmat4 to_matrix(const Pose& pose, const std::string& label) {
  const double length = glm::length(pose.rotation);
  if (!(length > 0) || !std::isfinite(length)) bad_input("{}: the rotation is not a quaternion of length 1", label);
  glm::dmat4 m = glm::mat4_cast(pose.rotation / length);
  for (int c = 0; c < 3; ++c) m[c] *= pose.scale[c];
  m[3] = glm::dvec4(pose.translation, 1);
  return m;
}

glm::dmat4 local_transform(const tinygltf::Node& node, const std::string& label) {
  return node.matrix.size() == 16 ? from_matrix(node.matrix, label) : to_matrix(pose_of(node), label);
}

bool is_finite(const glm::dmat4& m) {
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 4; ++r) {
      if (!std::isfinite(m[c][r])) return false;
    }
  }
  return true;
}

Transform to_transform(const glm::dmat4& m) {
  Transform out;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 4; ++c) out[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)] = m[c][r];
  }
  return out;
}

glm::dvec3 direction(const glm::dvec3& v, const char* what, const std::string& label) {
  const double longest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(longest > 0)) bad_input("{}: the transform leaves the {} no direction", label, what);
  return glm::normalize(v / longest);  // scaled first: squares of very large or small scales do not fit
}

Transform camera_frame(const glm::dmat4& m, const std::string& label) {
  const glm::dvec3 z = direction(m[2], "camera", label);
  const glm::dvec3 y = direction(m[1], "camera", label);
  // Of vectors that are nearly parallel, rounding is most of the cross product.
  const glm::dvec3 across = glm::cross(y, z);
  const bool is_flat = !(glm::length(across) > 1e-12);
  const glm::dvec3 side = direction(is_flat ? glm::dvec3(0) : across, "camera", label);
  const glm::dvec3 x = glm::normalize(side - glm::dot(side, z) * z);
  return to_transform(glm::dmat4(glm::dvec4(x, 0), glm::dvec4(glm::cross(z, x), 0), glm::dvec4(z, 0), m[3]));
}

void place_light(const glm::dmat4& m, const std::string& label, Light& light) {
  light.position = {m[3].x, m[3].y, m[3].z};
  if (!light_type_info(light.type).has(kHasDirection)) return;
  const glm::dvec3 d = direction(-glm::dvec3(m[2]), "light", label);
  light.direction = {d.x, d.y, d.z};
}

}  // namespace umbrix::io::detail
