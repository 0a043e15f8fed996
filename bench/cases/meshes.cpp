// SPDX-License-Identifier: Apache-2.0
#include "cases/meshes.h"

#include <cmath>
#include <map>
#include <utility>

namespace umbrix::cases {
namespace {

constexpr double kPi = 3.14159265358979323846;

struct Indexed {
  std::vector<Float3> points;
  std::vector<std::array<std::size_t, 3>> faces;
};

Indexed icosahedron() {
  const float g = 1.618034f;
  return {{{-1, g, 0},
           {1, g, 0},
           {-1, -g, 0},
           {1, -g, 0},
           {0, -1, g},
           {0, 1, g},
           {0, -1, -g},
           {0, 1, -g},
           {g, 0, -1},
           {g, 0, 1},
           {-g, 0, -1},
           {-g, 0, 1}},
          {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
           {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
           {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
}

Indexed split_faces(const Indexed& mesh) {
  Indexed result;
  result.points = mesh.points;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> middles;
  const auto middle = [&](std::size_t a, std::size_t b) {
    const auto [place, is_new] = middles.try_emplace(std::minmax(a, b), result.points.size());
    if (is_new) result.points.push_back(between(mesh.points[a], mesh.points[b], 0.5f));
    return place->second;
  };
  for (const auto& [a, b, c] : mesh.faces) {
    const std::size_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    result.faces.insert(result.faces.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  return result;
}

Float3 polar(double radius, double latitude, double longitude) {
  return {static_cast<float>(radius * std::cos(latitude) * std::cos(longitude)),
          static_cast<float>(radius * std::cos(latitude) * std::sin(longitude)),
          static_cast<float>(radius * std::sin(latitude))};
}

// Two triangles for each cell of a grid of points, without those that have lost their area.
template <typename Point>
Triangles grid(int rows, int columns, const Point& point) {
  Triangles result;
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const Float3 p00 = point(r, c), p01 = point(r, c + 1), p10 = point(r + 1, c), p11 = point(r + 1, c + 1);
      if (p00 != p01) result.push_back(triangle(p00, p01, p11));
      if (p10 != p11) result.push_back(triangle(p00, p11, p10));
    }
  }
  return result;
}

}  // namespace

ClosedMesh icosphere(int levels, float radius, float noise, Float3 center, Random& random) {
  Indexed mesh = icosahedron();
  for (int i = 0; i < levels; ++i) mesh = split_faces(mesh);
  for (Float3& p : mesh.points) {
    const float length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    p = add(center, scale(p, radius * random.uniform(1 - noise, 1 + noise) / length));
  }
  ClosedMesh result{{}, center};
  for (const auto& [a, b, c] : mesh.faces) {
    result.triangles.push_back(triangle(mesh.points[a], mesh.points[b], mesh.points[c]));
  }
  return result;
}

ClosedMesh ring_sphere(int rings, float radius, Float3 center) {
  const auto point = [&](int ring, int segment) {
    // The seam and the poles are the same point bit for bit, or the sphere would have holes.
    if (ring == 0) return add(center, {0, 0, -radius});
    if (ring == rings) return add(center, {0, 0, radius});
    const double latitude = kPi * (static_cast<double>(ring) / rings - 0.5);
    return add(center, polar(radius, latitude, 2 * kPi * (segment % rings) / rings));
  };
  return {grid(rings, rings, point), center};
}

Triangles torus(int rings, int segments, float major_radius, float minor_radius) {
  return grid(rings, segments, [&](int ring, int segment) {
    const double turn = 2 * kPi * (ring % rings) / rings;
    const double tube = 2 * kPi * (segment % segments) / segments;
    const double distance = major_radius + minor_radius * std::cos(tube);
    return Float3{static_cast<float>(distance * std::cos(turn)), static_cast<float>(distance * std::sin(turn)),
                  static_cast<float>(minor_radius * std::sin(tube))};
  });
}

Triangles sheet(int cells, float half_size, float height) {
  return grid(cells, cells, [&](int row, int column) {
    const auto place = [&](int i) { return half_size * (2 * static_cast<float>(i) / static_cast<float>(cells) - 1); };
    return Float3{place(column), place(row), height};
  });
}

Triangles soup(std::size_t count, float cube_half_size, float triangle_size, Random& random) {
  Triangles result;
  for (std::size_t i = 0; i < count; ++i) {
    const Float3 a = random.in_cube(cube_half_size);
    result.push_back(triangle(a, add(a, random.in_cube(triangle_size)), add(a, random.in_cube(triangle_size))));
  }
  return result;
}

oracle::Triangle triangle(const Float3& a, const Float3& b, const Float3& c) {
  return {{{a[0], a[1], a[2]}, {b[0], b[1], b[2]}, {c[0], c[1], c[2]}}};
}

Float3 vertex(const oracle::Triangle& t, std::size_t corner) {
  return {t.v[corner][0], t.v[corner][1], t.v[corner][2]};
}

Float3 add(const Float3& a, const Float3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Float3 subtract(const Float3& a, const Float3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Float3 scale(const Float3& a, float s) { return {a[0] * s, a[1] * s, a[2] * s}; }

Float3 between(const Float3& a, const Float3& b, float s) { return add(a, scale(subtract(b, a), s)); }

Float3 point_on(const oracle::Triangle& t, Random& random) {
  const std::size_t corner = random.below(3);
  const Float3 a = vertex(t, corner), b = vertex(t, (corner + 1) % 3), c = vertex(t, (corner + 2) % 3);
  switch (random.below(4)) {
    case 0:
      return a;
    case 1:
      return between(a, b, 0.5f);
    case 2:
      return between(a, b, random.uniform(0, 1));
    default:
      return between(between(a, b, random.uniform(0, 1)), c, random.uniform(0, 1));
  }
}

Ray ray_to(const Float3& origin, const Float3& target, float tmin, float tmax) {
  const Float3 d = subtract(target, origin);
  return {{origin[0], origin[1], origin[2]}, tmin, {d[0], d[1], d[2]}, tmax};
}

}  // namespace umbrix::cases
