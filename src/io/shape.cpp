// SPDX-License-Identifier: Apache-2.0
// Morph targets (glTF 2.0, section 3.7.2.2), then linear blend skinning (3.7.3.3). In double, rounded once.

#include "io/shape.h"

#include <cmath>

namespace umbrix::io::detail {
namespace {

glm::dvec3 wide(const Float3& v) { return {v[0], v[1], v[2]}; }

Float3 narrow(const glm::dvec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

glm::dvec3 morphed(const Float3& base, std::size_t vertex, const Shape& shape, std::vector<Float3> Shape::Target::*of,
                   const std::vector<double>& weights) {
  glm::dvec3 sum = wide(base);
  for (std::size_t t = 0; t < shape.targets.size(); ++t) {
    const std::vector<Float3>& deltas = shape.targets[t].*of;
    if (weights[t] != 0 && !deltas.empty()) sum += weights[t] * wide(deltas[vertex]);
  }
  return sum;
}

// Exporters round weights: divided by their sum, they move nothing that its joints leave alone.
glm::dmat4 blended(const Shape& shape, std::size_t vertex, const std::vector<glm::dmat4>& joints) {
  glm::dmat4 sum(0);
  double total = 0;
  for (std::size_t i = vertex * shape.influences; i < (vertex + 1) * shape.influences; ++i) {
    const double weight = shape.weights[i];
    if (weight == 0) continue;
    sum += joints[shape.joints[i]] * weight;
    total += weight;
  }
  return sum * (1 / total);
}

// By the inverse transpose, up to its length: the cofactors with the sign of the determinant.
glm::dvec3 turned(const glm::dmat3& m, const glm::dvec3& n) {
  const glm::dvec3 out = glm::cross(m[1], m[2]) * n.x + glm::cross(m[2], m[0]) * n.y + glm::cross(m[0], m[1]) * n.z;
  return glm::determinant(m) < 0 ? -out : out;
}

// Of no length if there is none worth the name.
Float3 unit(const glm::dvec3& n) {
  const double length = glm::length(n);
  return length > 0 && std::isfinite(length) ? narrow(n / length) : Float3{0, 0, 0};
}

bool most_mirror(const std::vector<glm::dmat4>& joints) {
  std::size_t mirroring = 0;
  for (const glm::dmat4& joint : joints) mirroring += glm::determinant(glm::dmat3(joint)) < 0;
  return 2 * mirroring > joints.size();
}

}  // namespace

PosedShape pose_shape(const Shape& shape, const std::vector<double>& morph_weights,
                      const std::vector<glm::dmat4>& joints) {
  PosedShape out;
  const bool carried = shape.influences > 0 && !joints.empty();
  const bool mirrored = carried && most_mirror(joints);
  if (mirrored) out.to_world[0][0] = -1;
  const glm::dvec3 mirror(mirrored ? -1 : 1, 1, 1);
  out.positions.reserve(shape.positions.size());
  out.normals.reserve(shape.normals.size());
  out.tangents.reserve(shape.tangents.size());
  for (std::size_t v = 0; v < shape.positions.size(); ++v) {
    const glm::dmat4 m = carried ? blended(shape, v, joints) : glm::dmat4(1);
    glm::dvec3 p = morphed(shape.positions[v], v, shape, &Shape::Target::positions, morph_weights);
    if (carried) p = mirror * glm::dvec3(m * glm::dvec4(p, 1));
    out.positions.push_back(narrow(p));
    if (!shape.normals.empty()) {
      glm::dvec3 n = morphed(shape.normals[v], v, shape, &Shape::Target::normals, morph_weights);
      if (carried) n = mirror * turned(glm::dmat3(m), n);
      out.normals.push_back(unit(n));
    }
    if (!shape.tangents.empty()) {
      const auto& [x, y, z, handedness] = shape.tangents[v];
      glm::dvec3 t = morphed({x, y, z}, v, shape, &Shape::Target::tangents, morph_weights);
      if (carried) t = mirror * (glm::dmat3(m) * t);
      const Float3 direction = unit(t);
      out.tangents.push_back({direction[0], direction[1], direction[2], handedness});
    }
  }
  return out;
}

}  // namespace umbrix::io::detail
