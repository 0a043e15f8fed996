// SPDX-License-Identifier: Apache-2.0
//
// Closed meshes seen from inside: nothing may leak (Woop, Benthin & Wald 2013 for edges and corners; Embree's own suite
// for the sphere far from the origin).
//
// Why every ray of from_inside is occluded. The triangles, those without area among them, form a cycle: each edge has
// its opposite (is_closed). So the winding number is constant off the surface but for points and lines of triangles
// without area, which separate nothing. It is +-1 at `inside` (winding_number, an integer but for rounding) and 0
// outside the mesh's box. A ray's origin is nearer to `inside` than any triangle (clearance), its end outside the box,
// so it meets a triangle with area: if it did not, then neither would a path beside it that avoids those lines.
// tests/oracle checks what the proof needs of each mesh.
#include "cases/closed_meshes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "cases/families.h"

namespace umbrix::cases {
namespace {

constexpr double kPi = 3.14159265358979323846;

using Double3 = std::array<double, 3>;

Double3 seen_from(const Float3& point, const float corner[3]) {
  return {double{corner[0]} - point[0], double{corner[1]} - point[1], double{corner[2]} - point[2]};
}

double dot(const Double3& a, const Double3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Double3 cross(const Double3& a, const Double3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double length(const Double3& a) { return std::sqrt(dot(a, a)); }

// Corners on a grid of 1/64, so that rays from grid points pass through corners and midpoints exactly.
ClosedMesh on_grid(ClosedMesh mesh) {
  for (oracle::Triangle& t : mesh.triangles) {
    for (auto& corner : t.v) {
      for (float& x : corner) x = std::round(x * 64) / 64;
    }
  }
  return mesh;
}

ClosedMesh tube(int rings) {
  ClosedMesh mesh{torus(rings, rings / 2, 2, 0.7f), {2, 0, 0}};
  return mesh;
}

float half_diagonal(const Triangles& triangles, const Float3& inside) {
  double farthest = 0;
  for (const oracle::Triangle& t : triangles) {
    for (const auto& corner : t.v) farthest = std::max(farthest, length(seen_from(inside, corner)));
  }
  return static_cast<float>(farthest);
}

Float3 aim_at(const oracle::Triangle& t, Aim aim, Random& random) {
  const std::size_t corner = random.below(3);
  const Float3 a = vertex(t, corner), b = vertex(t, (corner + 1) % 3), c = vertex(t, (corner + 2) % 3);
  switch (aim) {
    case Aim::vertex:
      return a;
    case Aim::edge:
      return between(a, b, random.chance(0.5) ? 0.5f : random.uniform(0, 1));
    default:
      return between(between(a, b, random.uniform(0.1f, 0.9f)), c, random.uniform(0.1f, 0.9f));
  }
}

}  // namespace

std::vector<ClosedMeshKind> closed_mesh_kinds(double size) {
  const bool full = size >= 0.01;
  std::vector<ClosedMeshKind> kinds;
  for (int level = 0; level <= 5; ++level) {
    const int used = full ? level : std::min(level, 3);
    kinds.push_back({"ico" + std::to_string(20 << (2 * level)), [used](Random& random) {
                       return icosphere(used, 1, 0, {0, 0, 0}, random);
                     }});
  }
  kinds.push_back({"star", [](Random& random) { return icosphere(3, 5, 0.3f, {1, 2, 3}, random); }});
  kinds.push_back({"star_fine", [full](Random& random) {
                     return icosphere(full ? 5 : 3, 2, 0.1f, {-1, 0, 7}, random);
                   }});
  kinds.push_back({"grid", [](Random& random) { return on_grid(icosphere(2, 8, 0.2f, {0, 0, 0}, random)); }});
  kinds.push_back({"torus", [full](Random&) { return tube(full ? 64 : 24); }});
  kinds.push_back({"far_sphere", [full](Random&) { return ring_sphere(full ? 200 : 24, 2, {148376, 1234, -223423}); }});
  kinds.push_back({"small_sphere", [](Random&) { return ring_sphere(20, 0.01f, {0, 0, 0}); }});
  return kinds;
}

bool is_closed(const Triangles& triangles) {
  std::map<std::pair<Float3, Float3>, int> open;
  for (const oracle::Triangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Float3 a = vertex(t, k), b = vertex(t, (k + 1) % 3);
      if (a == b) continue;
      ++open[{a, b}];
      --open[{b, a}];
    }
  }
  return std::all_of(open.begin(), open.end(), [](const auto& edge) { return edge.second == 0; });
}

double winding_number(const Triangles& triangles, const Float3& point) {
  double angle = 0;
  for (const oracle::Triangle& t : triangles) {
    const Double3 a = seen_from(point, t.v[0]), b = seen_from(point, t.v[1]), c = seen_from(point, t.v[2]);
    const double la = length(a), lb = length(b), lc = length(c);
    angle += 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return angle / (4 * kPi);
}

// A triangle is no nearer than the ball round its centre that holds its corners.
double clearance(const Triangles& triangles, const Float3& point) {
  double least = std::numeric_limits<double>::infinity();
  for (const oracle::Triangle& t : triangles) {
    const Double3 corners[3] = {seen_from(point, t.v[0]), seen_from(point, t.v[1]), seen_from(point, t.v[2])};
    Double3 center;
    for (std::size_t k = 0; k < 3; ++k) center[k] = (corners[0][k] + corners[1][k] + corners[2][k]) / 3;
    double radius = 0;
    for (const Double3& corner : corners) {
      radius = std::max(radius, length({corner[0] - center[0], corner[1] - center[1], corner[2] - center[2]}));
    }
    // Of large triangles the plane bounds better.
    const Double3 normal =
        cross({corners[1][0] - corners[0][0], corners[1][1] - corners[0][1], corners[1][2] - corners[0][2]},
              {corners[2][0] - corners[0][0], corners[2][1] - corners[0][1], corners[2][2] - corners[0][2]});
    const double area = length(normal);
    const double to_plane = area > 0 ? std::abs(dot(normal, corners[0])) / area : 0;
    least = std::min(least, std::max(length(center) - radius, to_plane));
  }
  return least * (1 - 1e-9);
}

CaseData from_inside(const ClosedMeshKind& kind, Aim aim, std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  const ClosedMesh mesh = kind.make(random);
  CaseData data{mesh.triangles, {}};
  data.rays.reserve(ray_count);
  // A cube of this half size lies within the ball; with room for the sum's rounding.
  const float room = static_cast<float>(clearance(mesh.triangles, mesh.inside) * 0.5);
  const float beyond = 4 * half_diagonal(mesh.triangles, mesh.inside);
  for (std::size_t i = 0; i < ray_count; ++i) {
    const oracle::Triangle& t = mesh.triangles[random.below(mesh.triangles.size())];
    // The exact centre for half of the rays; near it for the others.
    const Float3 away = random.chance(0.5) ? Float3{0, 0, 0} : random.in_cube(room);
    const Float3 origin = add(mesh.inside, away), target = aim_at(t, aim, random);
    const Float3 d = subtract(target, origin);
    const float largest = std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])});
    const bool endless = random.chance(0.5);
    data.rays.push_back(ray_to(origin, target, 0, endless ? std::numeric_limits<float>::infinity() : beyond / largest));
  }
  return data;
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
