// SPDX-License-Identifier: Apache-2.0
//
// Metamorphic cases: a change of triangles and rays that exact arithmetic knows to leave every answer as it was.
#include <algorithm>
#include <cmath>
#include <limits>

#include "cases/families.h"
#include "cases/meshes.h"

namespace umbrix::cases {
namespace {

// Small multiples of 2^-10: sums, differences and midpoints are floats, so that a segment can be turned round and an
// edge halved without rounding.
Float3 grid_point(float half_size, Random& random) {
  Float3 p = random.in_cube(half_size);
  for (float& x : p) x = std::round(x * 0x1p10f) * 0x1p-10f;
  return p;
}

CaseData plain(std::uint64_t seed, std::size_t ray_count, Random& random) {
  random = Random(seed);
  CaseData data;
  for (int i = 0; i < 150; ++i) {
    const Float3 a = grid_point(2, random);
    data.triangles.push_back(triangle(a, add(a, grid_point(0.5f, random)), add(a, grid_point(0.5f, random))));
  }
  for (std::size_t i = 0; i < ray_count; ++i) {
    const oracle::Triangle& t = data.triangles[random.below(data.triangles.size())];
    // At corners and middles of edges exactly, or at random.
    const std::size_t corner = random.below(3);
    Float3 target = grid_point(2, random);
    if (random.chance(0.3)) target = vertex(t, corner);
    if (random.chance(0.3)) target = between(vertex(t, corner), vertex(t, (corner + 1) % 3), 0.5f);
    const Float3 origin = grid_point(2, random);
    const Float3 d = scale(subtract(target, origin), random.chance(0.5) ? 1.0f : 2.0f);
    data.rays.push_back({{origin[0], origin[1], origin[2]}, 0, {d[0], d[1], d[2]}, 1});
  }
  return data;
}

// The plain case, and a copy of it that `change` turns into the other one.
template <typename Change>
CaseData twin(std::uint64_t seed, std::size_t ray_count, const Change& change) {
  Random random(seed);
  auto base = std::make_shared<CaseData>(plain(seed, ray_count, random));
  CaseData other{base->triangles, base->rays};
  change(other, random);
  other.same_as = std::move(base);
  return other;
}

// Changes each point and each vector of a case alike.
template <typename Change>
void change_vectors(CaseData& data, const Change& change) {
  for (oracle::Triangle& t : data.triangles) {
    for (auto& corner : t.v) change(corner);
  }
  for (Ray& ray : data.rays) {
    change(ray.origin);
    change(ray.direction);
  }
}

}  // namespace

CaseData duplicates(std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  auto base = std::make_shared<CaseData>();
  base->triangles = icosphere(1, 1, 0.2f, {0, 0, 0}, random).triangles;
  for (std::size_t i = 0; i < ray_count; ++i) {
    const Float3 target = point_on(base->triangles[random.below(base->triangles.size())], random);
    base->rays.push_back(ray_to(random.in_cube(2), target, 0, random.chance(0.3) ? 1.0f : random.uniform(0.5f, 4)));
  }
  CaseData data{{}, base->rays};
  const double kind = random.uniform(0, 1);
  const std::size_t copies = kind < 0.9 ? 2 + random.below(9) : kind < 0.98 ? 10 + random.below(90) : 1000;
  for (std::size_t i = 0; i < base->triangles.size() * copies; ++i) {
    oracle::Triangle t = base->triangles[i % base->triangles.size()];
    if (random.chance(0.3)) std::swap(t.v[1], t.v[2]);
    data.triangles.push_back(t);
  }
  data.same_as = std::move(base);
  return data;
}

CaseData permuted(std::uint64_t seed, std::size_t ray_count) {
  return twin(seed, ray_count, [](CaseData& data, Random& random) {
    for (std::size_t i = data.triangles.size(); i > 1; --i)
      std::swap(data.triangles[i - 1], data.triangles[random.below(i)]);
  });
}

CaseData flipped(std::uint64_t seed, std::size_t ray_count) {
  return twin(seed, ray_count, [](CaseData& data, Random& random) {
    for (oracle::Triangle& t : data.triangles) {
      const std::size_t corner = random.below(3);
      std::swap(t.v[corner], t.v[(corner + 1) % 3]);
    }
  });
}

CaseData mirrored(std::uint64_t seed, std::size_t ray_count) {
  return twin(seed, ray_count, [](CaseData& data, Random& random) {
    const std::size_t axis = random.below(3);
    change_vectors(data, [&](float v[3]) { v[axis] = -v[axis]; });
  });
}

CaseData axes_swapped(std::uint64_t seed, std::size_t ray_count) {
  return twin(seed, ray_count, [](CaseData& data, Random& random) {
    const std::size_t axis = random.below(3);
    change_vectors(data, [&](float v[3]) { std::swap(v[axis], v[(axis + 1) % 3]); });
  });
}

CaseData reversed(std::uint64_t seed, std::size_t ray_count) {
  return twin(seed, ray_count, [](CaseData& data, Random&) {
    for (Ray& ray : data.rays) {
      for (int k = 0; k < 3; ++k) {
        ray.origin[k] += ray.direction[k];
        ray.direction[k] = -ray.direction[k];
      }
    }
  });
}

CaseData split_in_four(std::uint64_t seed, std::size_t ray_count) {
  return twin(seed, ray_count, [](CaseData& data, Random&) {
    Triangles parts;
    for (const oracle::Triangle& t : data.triangles) {
      const Float3 a = vertex(t, 0), b = vertex(t, 1), c = vertex(t, 2);
      const Float3 ab = between(a, b, 0.5f), bc = between(b, c, 0.5f), ca = between(c, a, 0.5f);
      const Triangles four = {triangle(a, ab, ca), triangle(b, bc, ab), triangle(c, ca, bc), triangle(ab, bc, ca)};
      parts.insert(parts.end(), four.begin(), four.end());
    }
    data.triangles = std::move(parts);
  });
}

CaseData power_of_two_twin(std::uint64_t seed, std::size_t ray_count) {
  return twin(seed, ray_count, [](CaseData& data, Random& random) {
    // The powers of two nearest 1e-18, 1e-12, ... 1e18.
    const int exponents[] = {-60, -40, -20, 0, 20, 40, 60};
    const float s = std::ldexp(1.0f, exponents[random.below(7)]);
    change_vectors(data, [&](float v[3]) {
      for (int k = 0; k < 3; ++k) v[k] *= s;
    });
  });
}

}  // namespace umbrix::cases
