// SPDX-License-Identifier: Apache-2.0
#include "cases/instanced_meshes.h"

#include <cmath>
#include <limits>

namespace umbrix::cases {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

void set_entry(Instance& instance, int row, int column, double value) { instance.to_world[row][column] = value; }

/// A rotation from a random quaternion (Shoemake 1992), times `size`, moved by up to 2.
Instance turned(Random& random, double size) {
  double q[4], norm = 0;
  for (double& x : q) {
    x = static_cast<double>(random.uniform(-1, 1));
    norm += x * x;
  }
  for (double& x : q) x /= std::sqrt(norm);
  const double x = q[0], y = q[1], z = q[2], w = q[3];
  const double m[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
                          {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
                          {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}};
  Instance instance;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) set_entry(instance, row, column, size * m[row][column]);
    set_entry(instance, row, 3, size * static_cast<double>(random.uniform(-2, 2)));
  }
  return instance;
}

void scale_column(Instance& instance, int column, double factor) {
  for (auto& row : instance.to_world) row[column] *= factor;
}

Instance place(Placing placing, Random& random) {
  Instance instance = turned(random, 1);
  switch (placing) {
    case Placing::rigid:
      break;
    case Placing::sheared:
      for (auto& row : instance.to_world)
        for (int column = 0; column < 3; ++column) row[column] = static_cast<double>(random.uniform(-2, 2));
      break;
    case Placing::mirrored:
      scale_column(instance, static_cast<int>(random.below(3)), -1);
      break;
    case Placing::scaled:
      instance = turned(random, static_cast<double>(random.magnitude(-30, 30)));
      break;
    case Placing::squashed:
      for (int column = 0; column < 3; ++column)
        scale_column(instance, column, static_cast<double>(random.magnitude(-6, 6)));
      break;
    case Placing::flat:
      for (std::size_t axes = random.below(3) + 1; axes > 0; --axes)
        scale_column(instance, static_cast<int>(axes) - 1, random.chance(0.5) ? 0 : 1e-200);
      break;
    case Placing::far:
      for (auto& row : instance.to_world) row[3] = static_cast<double>(random.magnitude(2, 9) * random.sign());
      break;
    case Placing::overflow:
      if (random.chance(0.5)) break;
      instance = turned(random, static_cast<double>(random.magnitude(37, 38)) * 3);
      if (random.chance(0.3)) set_entry(instance, 1, 2, std::numeric_limits<double>::quiet_NaN());
      break;
  }
  return instance;
}

bool is_finite(const oracle::Triangle& t) {
  for (const auto& v : t.v)
    for (const float x : v)
      if (!std::isfinite(x)) return false;
  return true;
}

MeshView mesh_of(const Triangles& triangles) {
  MeshView mesh;
  mesh.vertices = triangles.empty() ? nullptr : &triangles[0].v[0][0];
  mesh.vertex_count = 3 * triangles.size();
  mesh.triangle_count = triangles.size();
  return mesh;
}

Triangles placed(const Triangles& local, const Instance& instance) {
  Triangles result(local.size());
  for (std::size_t i = 0; i < local.size(); ++i)
    for (int k = 0; k < 3; ++k) transform_point(instance.to_world, local[i].v[k], result[i].v[k]);
  return result;
}

/// Some triangles with no area, and one that has no finite vertex.
Triangles with_bad_ones(Triangles triangles, Random& random) {
  for (int i = 0; i < 3; ++i) {
    oracle::Triangle& t = triangles[random.below(triangles.size())];
    t = triangle(vertex(t, 0), vertex(t, 1), between(vertex(t, 0), vertex(t, 1), 0.5f));
  }
  triangles[random.below(triangles.size())].v[1][2] = kInfinity;
  return triangles;
}

bool lets_through(const void*, std::uint32_t triangle, float u, float v) { return ((triangle & 1u) != 0) != (u < v); }

}  // namespace

std::string name_of(Placing placing) {
  constexpr const char* kNames[] = {"rigid", "sheared", "mirrored", "scaled", "squashed", "flat", "far", "overflow"};
  return kNames[static_cast<std::size_t>(placing)];
}

InstancedMeshes::InstancedMeshes(Placing placing, std::uint64_t seed) {
  Random random(seed);
  prototypes_[0] = with_bad_ones(icosphere(2, 1, 0.3f, {0.1f, 0, 0}, random).triangles, random);
  prototypes_[1] = sheet(6, 1, 0.25f);
  for (std::uint32_t i = 0; i < 9; ++i) {
    Part part{i % 3 != 1, {}, {}};
    if (part.is_instance) {
      part.instance = place(placing, random);
      part.instance.prototype = i % 2;
      // The same place twice: what is hit is hit twice, and the first must be told.
      if (i == 8) part.instance = parts_[6].instance;
    } else {
      part.local = i == 4 ? placed(prototypes_[0], parts_[3].instance) : soup(40, 1, 0.5f, random);
    }
    world_.push_back(part.is_instance ? placed(prototypes_[part.instance.prototype], part.instance) : part.local);
    parts_.push_back(std::move(part));
  }
  for (const Triangles& mesh : world_) {
    for (const oracle::Triangle& t : mesh) {
      if (is_finite(t)) targets_.push_back(static_cast<std::uint32_t>(all_.size()));
      all_.push_back(t);
    }
  }
}

std::uint32_t InstancedMeshes::mask_of(std::size_t part) const { return is_filtered ? 1u << part % 3 : 0xFFFFFFFFu; }

OpacityTest InstancedMeshes::opacity_of(std::size_t part) const {
  return is_filtered && part % 4 < 2 ? OpacityTest{lets_through, nullptr} : OpacityTest{};
}

Status InstancedMeshes::build_instanced(Scene& scene) const {
  for (const Triangles& prototype : prototypes_)
    if (Status status = scene.add_prototype(mesh_of(prototype)); !status) return status;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    Instance instance = parts_[i].instance;
    instance.mask = mask_of(i);
    instance.opacity = opacity_of(i);
    MeshView mesh = mesh_of(parts_[i].local);
    mesh.mask = instance.mask;
    mesh.opacity = instance.opacity;
    std::uint32_t number = Primitive::kNone;
    if (Status status = parts_[i].is_instance ? scene.add_instance(instance, &number) : scene.add(mesh, &number);
        !status)
      return status;
    if (number != i) return {StatusCode::internal, "a mesh has the wrong number"};
  }
  return scene.commit();
}

Status InstancedMeshes::build_flat(Scene& scene) const {
  for (std::size_t i = 0; i < world_.size(); ++i) {
    MeshView mesh = mesh_of(world_[i]);
    mesh.mask = mask_of(i);
    mesh.opacity = opacity_of(i);
    if (Status status = scene.add(mesh); !status) return status;
  }
  return scene.commit();
}

Primitive InstancedMeshes::primitive(std::uint32_t triangle) const {
  std::uint32_t mesh = 0;
  while (triangle >= world_[mesh].size()) triangle -= static_cast<std::uint32_t>(world_[mesh++].size());
  return {mesh, triangle};
}

std::vector<Ray> InstancedMeshes::rays(std::size_t count, std::uint64_t seed) const {
  Random random(seed);
  const auto point = [&]() -> Float3 { return point_on(all_[targets_[random.below(targets_.size())]], random); };
  std::vector<Ray> rays(count);
  for (std::size_t i = 0; i < count; ++i) {
    const oracle::Triangle& t = all_[targets_[random.below(targets_.size())]];
    const Float3 target = point_on(t, random);
    Float3 origin = point();  // on another triangle
    switch (i % 6) {
      case 0:
        break;
      case 1:  // in the triangle's plane, or nearly
        origin = add(vertex(t, 0), scale(subtract(vertex(t, 1), vertex(t, 2)), random.uniform(-2, 2)));
        break;
      case 2:  // near by, with the triangle's own size
        origin = add(target, scale(random.direction(), 3 * std::abs(vertex(t, 1)[0] - vertex(t, 0)[0])));
        break;
      case 3:  // from afar
        origin = add(target, scale(random.direction(), random.magnitude(-2, 12)));
        break;
      case 4:  // along an axis
        origin = target;
        origin[random.below(3)] += random.uniform(-4, 4);
        break;
      default:
        origin = random.in_cube(3);
    }
    rays[i] = ray_to(origin, target, 0, random.chance(0.5) ? kInfinity : 1);
    if (random.chance(0.1)) rays[i].tmax = std::nextafter(1.0f, random.chance(0.5) ? 2.0f : 0.0f);
    if (random.chance(0.1)) rays[i].tmin = random.chance(0.5) ? -kInfinity : -0.5f;
    if (random.chance(0.01)) rays[i].direction[1] = random.chance(0.5) ? kInfinity : std::nanf("");
  }
  return rays;
}

}  // namespace umbrix::cases
