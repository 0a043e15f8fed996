// SPDX-License-Identifier: Apache-2.0
//
// Closed meshes seen from inside (nothing may leak) and past their outlines. Robustness literature: Woop, Benthin &
// Wald 2013 for edges and corners; Embree's own suite for the sphere far from the origin.
#include <cmath>
#include <limits>

#include "cases/families.h"
#include "cases/meshes.h"

namespace umbrix::cases {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

ClosedMesh any_closed_mesh(Random& random) {
  switch (random.below(5)) {
    case 0:
      return icosphere(2, 1, 0, {0, 0, 0}, random);
    case 1:
      return icosphere(3, 5, 0.3f, {1, 2, 3}, random);
    case 2:
      return ring_sphere(24, 2, {148376, 1234, -223423});
    case 3:
      return ring_sphere(20, 0.01f, {0, 0, 0});
    default: {
      // Corners on a grid of 1/64, so that rays from grid points pass through corners and midpoints exactly.
      ClosedMesh mesh = icosphere(2, 8, 0.2f, {0, 0, 0}, random);
      for (oracle::Triangle& t : mesh.triangles) {
        for (auto& corner : t.v) {
          for (float& x : corner) x = std::round(x * 64) / 64;
        }
      }
      return mesh;
    }
  }
}

template <typename Target>
CaseData from_inside(std::uint64_t seed, std::size_t ray_count, const Target& target) {
  Random random(seed);
  const ClosedMesh mesh = any_closed_mesh(random);
  CaseData data{mesh.triangles, {}};
  for (std::size_t i = 0; i < ray_count; ++i) {
    const oracle::Triangle& t = mesh.triangles[random.below(mesh.triangles.size())];
    // The exact centre for half of the rays; near it for the others.
    const Float3 away = random.chance(0.5) ? Float3{0, 0, 0} : scale(subtract(vertex(t, 0), mesh.inside), 0.1f);
    data.rays.push_back(ray_to(add(mesh.inside, away), target(t, random), 0, random.chance(0.5) ? kInfinity : 8.0f));
  }
  return data;
}

}  // namespace

CaseData closed_interior(std::uint64_t seed, std::size_t ray_count) {
  return from_inside(seed, ray_count, [](const oracle::Triangle& t, Random& random) {
    return between(between(vertex(t, 0), vertex(t, 1), random.uniform(0.1f, 0.9f)), vertex(t, 2),
                   random.uniform(0.1f, 0.9f));
  });
}

CaseData closed_corners(std::uint64_t seed, std::size_t ray_count) {
  return from_inside(seed, ray_count,
                     [](const oracle::Triangle& t, Random& random) { return vertex(t, random.below(3)); });
}

CaseData closed_midpoints(std::uint64_t seed, std::size_t ray_count) {
  return from_inside(seed, ray_count, [](const oracle::Triangle& t, Random& random) {
    const std::size_t corner = random.below(3);
    return between(vertex(t, corner), vertex(t, (corner + 1) % 3), 0.5f);
  });
}

CaseData closed_edges(std::uint64_t seed, std::size_t ray_count) {
  return from_inside(seed, ray_count, [](const oracle::Triangle& t, Random& random) {
    const std::size_t corner = random.below(3);
    return between(vertex(t, corner), vertex(t, (corner + 1) % 3), random.uniform(0, 1));
  });
}

CaseData silhouettes(std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  CaseData data;
  data.triangles = random.chance(0.5) ? torus(24, 12, 2, 0.7f) : icosphere(2, 2, 0.1f, {0, 0, 0}, random).triangles;
  for (std::size_t i = 0; i < ray_count; ++i) {
    const oracle::Triangle& t = data.triangles[random.below(data.triangles.size())];
    // Through a point of the surface, along it: a neighbour's corner gives the direction.
    const Float3 through = point_on(t, random);
    const Float3 along = scale(subtract(vertex(t, random.below(3)), through), 8);
    const Float3 tilt = random.in_cube(random.magnitude(-7, -1));
    const Float3 d = add(along, tilt);
    const Float3 origin = subtract(through, d);
    data.rays.push_back({{origin[0], origin[1], origin[2]}, 0, {d[0], d[1], d[2]}, random.uniform(0.5f, 4)});
  }
  return data;
}

}  // namespace umbrix::cases
