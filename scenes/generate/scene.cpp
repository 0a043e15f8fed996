// SPDX-License-Identifier: Apache-2.0
#include "scene.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <utility>

#include "numbers.h"

namespace umbrix::scenes {

using glm::dvec3;

void Mesh::add(std::uint32_t material, const Shape& shape) {
  Shape on_grid = shape;
  for (dvec3& p : on_grid.positions) p = snapped(p);
  for (const glm::uvec3& t : on_grid.triangles) {
    const dvec3& a = on_grid.positions[t.x];
    if (glm::cross(on_grid.positions[t.y] - a, on_grid.positions[t.z] - a) == dvec3(0)) {
      throw std::logic_error("mesh \"" + name + "\" has a triangle without area");
    }
  }
  const auto same = [&](const Part& p) { return p.material == material && p.shape.smooth == shape.smooth; };
  const auto part = std::find_if(parts.begin(), parts.end(), same);
  if (part == parts.end()) {
    parts.push_back({material, std::move(on_grid)});
  } else {
    append(part->shape, on_grid);
  }
}

std::uint32_t Scene::add(Material material) {
  materials.push_back(std::move(material));
  return static_cast<std::uint32_t>(materials.size() - 1);
}

std::uint32_t Scene::add(Mesh mesh) {
  meshes.push_back(std::move(mesh));
  return static_cast<std::uint32_t>(meshes.size() - 1);
}

void Scene::place(Mesh mesh, const dvec3& position, double turns_around_y) {
  place(add(std::move(mesh)), position, turns_around_y);
}

void Scene::place(std::uint32_t mesh, const dvec3& position, double turns_around_y, const dvec3& scale) {
  nodes.push_back({mesh, position, rotation({0, 1, 0}, turns_around_y), scale});
}

glm::dquat rotation(const dvec3& axis, double turns) {
  const double s = sin_turns(turns / 2);
  return {cos_turns(turns / 2), axis.x * s, axis.y * s, axis.z * s};
}

Mesh sky(Scene& scene, double radius, double height, double first_turn, double last_turn) {
  const dvec3 horizon(0.95, 0.97, 1.0), zenith(0.3, 0.52, 0.9);
  constexpr int kBands = 24;
  Mesh mesh{"sky", {}};
  for (int i = 0; i < kBands; ++i) {
    // From the middle of the circle the bands look equally high where the angle is small, which is where we look.
    const double low = height * i / kBands, high = height * (i + 1) / kBands;
    const double blue = static_cast<double>(i) / (kBands - 1);
    const dvec3 emission = horizon + (zenith - horizon) * (blue * (2 - blue));
    const std::uint32_t material = scene.add(
        Material{"sky " + std::to_string(i),
                 dvec3(0),
                 1,
                 0,
                 {snapped(emission.x, 1.0 / 1024), snapped(emission.y, 1.0 / 1024), snapped(emission.z, 1.0 / 1024)}});
    mesh.add(material, sheet(16, 1, [&](double u, double v) {
               const double turns = last_turn + (first_turn - last_turn) * u;
               return dvec3(radius * cos_turns(turns), low + (high - low) * v, -radius * sin_turns(turns));
             }));
  }
  return mesh;
}

}  // namespace umbrix::scenes
