// SPDX-License-Identifier: Apache-2.0
#include "shape.h"

#include <glm/geometric.hpp>
#include <stdexcept>

#include "numbers.h"

namespace umbrix::scenes {

using glm::dvec3;

void Shape::quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  triangles.push_back({a, b, c});
  triangles.push_back({a, c, d});
}

void append(Shape& to, const Shape& from) {
  if (to.smooth != from.smooth) throw std::logic_error("smooth and flat shapes do not mix");
  const auto base = static_cast<std::uint32_t>(to.positions.size());
  to.positions.insert(to.positions.end(), from.positions.begin(), from.positions.end());
  for (const glm::uvec3& t : from.triangles) to.triangles.push_back(t + base);
}

Shape moved(Shape shape, const dvec3& by) {
  for (dvec3& p : shape.positions) p += by;
  return shape;
}

dvec3 turned(const dvec3& point, const dvec3& axis, double turns) {
  const double c = cos_turns(turns), s = sin_turns(turns);
  return point * c + glm::cross(axis, point) * s + axis * (glm::dot(axis, point) * (1 - c));
}

Shape turned(Shape shape, const dvec3& axis, double turns) {
  for (dvec3& p : shape.positions) p = turned(p, axis, turns);
  return shape;
}

Shape stretched(Shape shape, const dvec3& factors) {
  for (dvec3& p : shape.positions) p *= factors;
  const bool mirrored = factors.x * factors.y * factors.z < 0;
  if (mirrored) {
    for (glm::uvec3& t : shape.triangles) std::swap(t.y, t.z);
  }
  return shape;
}

std::vector<dvec3> normals(const Shape& shape) {
  std::vector<dvec3> result(shape.positions.size(), dvec3(0));
  for (const glm::uvec3& t : shape.triangles) {
    const dvec3& a = shape.positions[t.x];
    const dvec3 doubled_area = glm::cross(shape.positions[t.y] - a, shape.positions[t.z] - a);
    for (int corner = 0; corner < 3; ++corner) result[t[corner]] += doubled_area;
  }
  for (dvec3& n : result) {
    const double length = glm::length(n);
    if (length == 0) throw std::logic_error("a vertex without a normal");
    n /= length;
  }
  return result;
}

}  // namespace umbrix::scenes
