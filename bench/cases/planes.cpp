// SPDX-License-Identifier: Apache-2.0
//
// Rays in special position to planes: those of triangles, of the axes, and those on which a tree would split, which lie
// at vertex coordinates or 2^-20 of the scene's extent beside them.
#include <algorithm>
#include <cmath>
#include <limits>

#include "cases/families.h"
#include "cases/meshes.h"

namespace umbrix::cases {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// A vertex coordinate, the same grown by a tree's safety margin, or its neighbour among the floats.
float split_coordinate(const Triangles& triangles, std::size_t axis, float extent, Random& random) {
  const float x = triangles[random.below(triangles.size())].v[random.below(3)][axis];
  switch (random.below(6)) {
    case 0:
      return x + extent * 0x1p-20f;
    case 1:
      return x - extent * 0x1p-20f;
    case 2:
      return std::nextafter(x, kInfinity);
    case 3:
      return std::nextafter(x, -kInfinity);
    default:
      return x;
  }
}

Float3 split_corner(const Triangles& triangles, float extent, Random& random) {
  Float3 p;
  for (std::size_t k = 0; k < 3; ++k) p[k] = split_coordinate(triangles, k, extent, random);
  return p;
}

// Boxes, a sphere and a soup: planes at equal coordinates as well as at random ones.
Triangles room(Random& random) {
  Triangles result = soup(100, 1, 0.4f, random);
  const Triangles ball = icosphere(1, 0.5f, 0, {0.25f, 0, 0}, random).triangles;
  result.insert(result.end(), ball.begin(), ball.end());
  for (const float height : {-1.0f, -0.5f, 1.0f}) {
    const Triangles floor = sheet(3, 1, height);
    result.insert(result.end(), floor.begin(), floor.end());
    for (oracle::Triangle wall : floor) {
      for (auto& corner : wall.v) std::swap(corner[0], corner[2]);
      result.push_back(wall);
    }
  }
  return result;
}

}  // namespace

CaseData grazing(int exponent, std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  CaseData data{sheet(16, 100, random.chance(0.5) ? 0.0f : 1.7f), {}};
  if (random.chance(0.5)) {  // tilted, so that the plane is not representable
    for (oracle::Triangle& t : data.triangles) {
      for (auto& corner : t.v) corner[2] += 0.3f * corner[0] - 0.7f * corner[1];
    }
  }
  for (std::size_t i = 0; i < ray_count; ++i) {
    const Float3 target = point_on(data.triangles[random.below(data.triangles.size())], random);
    const Float3 other = point_on(data.triangles[random.below(data.triangles.size())], random);
    Float3 d = subtract(target, other);
    d[2] += 100 * random.magnitude(exponent, exponent + 1) * random.sign();
    data.rays.push_back({{target[0] - d[0], target[1] - d[1], target[2] - d[2]},
                         0,
                         {d[0], d[1], d[2]},
                         random.chance(0.5) ? kInfinity : random.uniform(0.9f, 1.1f)});
  }
  return data;
}

CaseData axis_parallel(std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  CaseData data{room(random), {}};
  for (std::size_t i = 0; i < ray_count; ++i) {
    const Float3 target = point_on(data.triangles[random.below(data.triangles.size())], random);
    Float3 d = {0, 0, 0};
    const std::size_t zeros = 1 + random.below(2);
    const std::size_t first = random.below(3);
    for (std::size_t k = 0; k < 3; ++k) {
      const bool is_zero = k < zeros;
      const float tiny = random.chance(0.3) ? random.magnitude(-45, -38) : 0;
      d[(first + k) % 3] = (is_zero ? tiny : random.magnitude(-3, 1)) * random.sign();
    }
    const float back = random.chance(0.5) ? 4.0f : random.uniform(0, 4);
    const Float3 origin = subtract(target, scale(d, back));
    data.rays.push_back({{origin[0], origin[1], origin[2]},
                         0,
                         {d[0], d[1], d[2]},
                         random.chance(0.5) ? kInfinity : random.uniform(0, 8)});
  }
  return data;
}

CaseData split_planes(std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  CaseData data{room(random), {}};
  for (std::size_t i = 0; i < ray_count; ++i) {
    Float3 origin = random.in_cube(1.5f);
    Float3 d = random.direction();
    // One or two coordinates never leave their plane.
    const std::size_t axis = random.below(3);
    origin[axis] = split_coordinate(data.triangles, axis, 2, random);
    d[axis] = 0.0f * random.sign();
    if (random.chance(0.3)) {
      const std::size_t second = (axis + 1) % 3;
      origin[second] = split_coordinate(data.triangles, second, 2, random);
      d[second] = 0.0f * random.sign();
    }
    data.rays.push_back({{origin[0], origin[1], origin[2]},
                         random.chance(0.5) ? 0.0f : -kInfinity,
                         {d[0], d[1], d[2]},
                         random.chance(0.5) ? kInfinity : random.uniform(0, 4)});
  }
  return data;
}

CaseData box_corners(std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  CaseData data{room(random), {}};
  for (std::size_t i = 0; i < ray_count; ++i) {
    const Float3 through = split_corner(data.triangles, 2, random);
    const Float3 origin = random.chance(0.5) ? split_corner(data.triangles, 2, random) : random.in_cube(3);
    Ray ray = ray_to(origin, through, 0, random.chance(0.5) ? kInfinity : random.uniform(0.5f, 3));
    if (random.chance(0.5)) {  // normalised, so that the corner is missed by a rounding
      const float* d = ray.direction;
      const float length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
      if (length > 0) {
        for (float& x : ray.direction) x /= length;
        ray.tmax *= length;
      }
    }
    data.rays.push_back(ray);
  }
  return data;
}

CaseData origins_on_geometry(std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  CaseData data{room(random), {}};
  for (std::size_t i = 0; i < ray_count; ++i) {
    const oracle::Triangle& t = data.triangles[random.below(data.triangles.size())];
    const Float3 origin = random.chance(0.3) ? split_corner(data.triangles, 2, random) : point_on(t, random);
    const Float3 target = random.chance(0.5) ? point_on(data.triangles[random.below(data.triangles.size())], random)
                                             : add(origin, random.direction());
    const float tmin = random.chance(0.5) ? 0.0f : random.magnitude(-7, -1) * random.sign();
    data.rays.push_back(ray_to(origin, target, tmin, random.chance(0.5) ? 1.0f : kInfinity));
  }
  return data;
}

CaseData flat_scene(std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  CaseData data{sheet(8, 1, 0.25f), {}};
  const std::size_t axis = random.below(3);
  for (oracle::Triangle& t : data.triangles) {
    for (auto& corner : t.v) std::swap(corner[axis], corner[2]);
  }
  for (std::size_t i = 0; i < ray_count; ++i) {
    const Float3 target = point_on(data.triangles[random.below(data.triangles.size())], random);
    Float3 origin = random.in_cube(2);
    if (random.chance(0.2)) origin[axis] = 0.25f;
    data.rays.push_back(ray_to(origin, target, 0, random.chance(0.5) ? 1.0f : 2.0f));
  }
  return data;
}

CaseData tilted_flat_scene(std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  // Halves and quarters of small numbers: the plane is exact though no axis is in it.
  const auto height = [](const Float3& p) { return 0.5f * p[0] - 0.25f * p[1] + 0.125f; };
  CaseData data{sheet(8, 1, 0), {}};
  for (oracle::Triangle& t : data.triangles) {
    for (auto& corner : t.v) corner[2] = height({corner[0], corner[1], 0});
  }
  for (std::size_t i = 0; i < ray_count; ++i) {
    const Float3 target = point_on(data.triangles[random.below(data.triangles.size())], random);
    Float3 origin = random.in_cube(2);
    if (random.chance(0.2)) {
      for (float& x : origin) x = std::round(x * 16) / 16;
      origin[2] = height(origin);
    }
    data.rays.push_back(ray_to(origin, target, 0, random.chance(0.5) ? 1.0f : 2.0f));
  }
  return data;
}

CaseData integer_grid(std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  const auto grid_point = [&](int half_size) {
    Float3 p;
    for (float& x : p) {
      x = static_cast<float>(static_cast<int>(random.below(static_cast<std::size_t>(2 * half_size + 1))) - half_size);
    }
    return p;
  };
  CaseData data;
  const int half_size = random.chance(0.5) ? 4 : 12;
  for (int i = 0; i < 120; ++i)
    data.triangles.push_back(triangle(grid_point(half_size), grid_point(half_size), grid_point(half_size)));
  for (std::size_t i = 0; i < ray_count; ++i) {
    data.rays.push_back(ray_to(grid_point(2 * half_size), grid_point(half_size), 0, random.chance(0.5) ? 1.0f : 2.0f));
  }
  return data;
}

}  // namespace umbrix::cases
