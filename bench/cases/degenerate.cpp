// SPDX-License-Identifier: Apache-2.0
//
// Triangles that builders and tests dislike: without area, needles, many through one point or edge, and of all sizes.
#include <cmath>
#include <limits>

#include "cases/families.h"
#include "cases/meshes.h"

namespace umbrix::cases {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Rays at points, edges and corners of the triangles, from around them.
void aim_at_triangles(CaseData& data, std::size_t ray_count, float half_size, Random& random) {
  for (std::size_t i = 0; i < ray_count; ++i) {
    const Float3 target = point_on(data.triangles[random.below(data.triangles.size())], random);
    const Float3 origin = random.in_cube(half_size);
    data.rays.push_back(ray_to(origin, target, 0, random.chance(0.3) ? 1.0f : random.uniform(0.5f, 4)));
  }
}

}  // namespace

CaseData degenerate_soup(std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  CaseData data{soup(300, 1, 0.4f, random), {}};
  for (std::size_t i = 0; i < data.triangles.size(); i += 2) {
    const Float3 a = vertex(data.triangles[i], 0), b = vertex(data.triangles[i], 1);
    switch (random.below(4)) {
      case 0:
        data.triangles[i] = triangle(a, a, a);
        break;
      case 1:
        data.triangles[i] = triangle(a, b, a);
        break;
      case 2:  // exactly collinear
        data.triangles[i] = triangle({1, 2, 3}, {2, 4, 6}, {0.5f, 1, 1.5f});
        break;
      default:  // collinear but for rounding: a needle with some area
        data.triangles[i] = triangle(a, b, between(a, b, random.uniform(-1, 2)));
    }
  }
  aim_at_triangles(data, ray_count, 1.5f, random);
  return data;
}

CaseData slivers(std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  CaseData data;
  for (int i = 0; i < 250; ++i) {
    const Float3 a = random.in_cube(1), b = random.in_cube(1);
    const float width = random.magnitude(-7, -2);
    data.triangles.push_back(triangle(a, b, add(between(a, b, random.uniform(-0.2f, 1.2f)), random.in_cube(width))));
  }
  aim_at_triangles(data, ray_count, 1.5f, random);
  return data;
}

CaseData coincident(std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  CaseData data;
  const oracle::Triangle t = triangle(random.in_cube(1), random.in_cube(1), random.in_cube(1));
  data.triangles.assign(1 + random.below(1000), t);
  aim_at_triangles(data, ray_count, 2, random);
  return data;
}

CaseData fan(std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  CaseData data;
  const Float3 apex = random.chance(0.5) ? Float3{0, 0, 0} : random.in_cube(1);
  Float3 previous = random.in_cube(1);
  for (int i = 0; i < 500; ++i) {
    const Float3 next = random.chance(0.9) ? add(previous, random.in_cube(0.2f)) : random.in_cube(1);
    data.triangles.push_back(triangle(apex, previous, next));
    previous = next;
  }
  aim_at_triangles(data, ray_count, 2, random);
  for (std::size_t i = 0; i < ray_count; i += 4) {
    const Float3 origin = random.in_cube(2);
    data.rays[i] = ray_to(origin, apex, 0, random.chance(0.5) ? 1.0f : kInfinity);
  }
  return data;
}

CaseData shared_edge(std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  CaseData data;
  const Float3 a = random.in_cube(1);
  const Float3 b = add(a, scale(random.direction(), 10));
  for (int i = 0; i < 500; ++i) data.triangles.push_back(triangle(a, b, random.in_cube(3)));
  aim_at_triangles(data, ray_count, 6, random);
  for (std::size_t i = 0; i < ray_count; i += 4) {
    data.rays[i] = ray_to(random.in_cube(6), between(a, b, random.uniform(0, 1)), 0, random.uniform(0.9f, 2));
  }
  return data;
}

CaseData nested_sizes(std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  CaseData data;
  for (int k = 0; k <= 60; ++k) {
    for (oracle::Triangle t : soup(3, 1, 1, random)) {
      for (auto& corner : t.v) {
        for (float& x : corner) x = std::ldexp(x, -k);
      }
      data.triangles.push_back(t);
    }
  }
  for (std::size_t i = 0; i < ray_count; ++i) {
    const Float3 target = point_on(data.triangles[random.below(data.triangles.size())], random);
    const Float3 origin = scale(random.in_cube(2), std::ldexp(1.0f, -static_cast<int>(random.below(61))));
    data.rays.push_back(ray_to(origin, target, 0, random.chance(0.5) ? 2.0f : kInfinity));
  }
  return data;
}

CaseData cantor_dust(std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  CaseData data;
  // Points whose coordinates have no digit 1 in base 3: clusters of clusters, down to a float's last bits.
  const auto dust_point = [&] {
    Float3 p;
    for (float& x : p) {
      double sum = 0, digit = 1;
      for (int level = 0; level < 16; ++level) {
        digit /= 3;
        sum += random.chance(0.5) ? 2 * digit : 0;
      }
      x = static_cast<float>(sum);
    }
    return p;
  };
  for (int i = 0; i < 300; ++i) {
    const Float3 a = dust_point();
    const float size = static_cast<float>(std::pow(3.0, -static_cast<double>(1 + random.below(14))));
    data.triangles.push_back(triangle(a, add(a, random.in_cube(size)), add(a, random.in_cube(size))));
  }
  aim_at_triangles(data, ray_count, 1.5f, random);
  return data;
}

}  // namespace umbrix::cases
