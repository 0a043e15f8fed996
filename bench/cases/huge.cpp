// SPDX-License-Identifier: Apache-2.0
//
// Scenes of a hundred thousand to ten million triangles.
#include <cmath>
#include <limits>

#include "cases/families.h"
#include "cases/meshes.h"

namespace umbrix::cases {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

// At and past points, edges and corners of the triangles.
void aim_at_triangles(CaseData& data, std::size_t ray_count, float half_size, Random& random) {
  data.rays.reserve(ray_count);
  for (std::size_t i = 0; i < ray_count; ++i) {
    const Float3 target = point_on(data.triangles[random.below(data.triangles.size())], random);
    data.rays.push_back(
        ray_to(random.in_cube(half_size), target, 0, random.chance(0.5) ? 1.0f : random.uniform(0.3f, 2)));
  }
}

// So small that a segment of the cube's size meets one or two of them.
Triangles thin_soup(std::size_t count, Random& random) {
  return soup(count, 1, 1 / std::sqrt(static_cast<float>(count)), random);
}

}  // namespace

CaseData huge_degenerate_soup(std::size_t count, std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  CaseData data{thin_soup(count, random), {}};
  for (std::size_t i = 0; i < data.triangles.size(); i += 2) {
    const Float3 a = vertex(data.triangles[i], 0), b = vertex(data.triangles[i], 1);
    const std::size_t kind = random.below(3);
    // A point, a line with a corner twice, and one whose middle is exact.
    data.triangles[i] = kind == 0   ? triangle(a, a, a)
                        : kind == 1 ? triangle(a, b, a)
                                    : triangle({0, 0, 0}, b, scale(b, 2));
  }
  aim_at_triangles(data, ray_count, 1, random);
  return data;
}

CaseData huge_soup_with_one_bad(std::size_t count, std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  CaseData data{thin_soup(count, random), {}};
  aim_at_triangles(data, ray_count, 1, random);
  const float values[] = {kNaN, kInfinity, -kInfinity, std::numeric_limits<float>::denorm_min()};
  for (const float value : values) {
    data.triangles[random.below(count)].v[random.below(3)][random.below(3)] = value;
  }
  return data;
}

CaseData huge_coincident(std::size_t count, std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  CaseData data;
  data.triangles.assign(count, triangle(random.in_cube(1), random.in_cube(1), random.in_cube(1)));
  aim_at_triangles(data, ray_count, 2, random);
  return data;
}

CaseData huge_fan(std::size_t count, std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  CaseData data;
  const Float3 apex = random.in_cube(0.1f);
  data.triangles.reserve(count);
  const float size = 4 / std::sqrt(static_cast<float>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const Float3 far = random.direction();
    data.triangles.push_back(triangle(apex, far, add(far, random.in_cube(size))));
  }
  aim_at_triangles(data, ray_count, 2, random);
  // Every hundredth at the vertex of all.
  for (std::size_t i = 50; i < ray_count; i += 100) data.rays[i] = ray_to(random.in_cube(2), apex, 0, 2);
  return data;
}

CaseData huge_shared_edge(std::size_t count, std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  CaseData data;
  const Float3 a = random.in_cube(1), b = add(a, scale(random.direction(), 10));
  data.triangles.reserve(count);
  for (std::size_t i = 0; i < count; ++i) data.triangles.push_back(triangle(a, b, random.in_cube(3)));
  // Half of the rays from beside the edge, so that some pass between two triangles.
  for (std::size_t i = 0; i < ray_count; ++i) {
    const Float3 at = between(a, b, random.uniform(0, 1));
    const Float3 origin = random.chance(0.5) ? random.in_cube(6) : add(at, random.in_cube(random.magnitude(-6, 0)));
    data.rays.push_back(ray_to(origin, add(at, random.in_cube(random.magnitude(-7, 0))), 0, random.uniform(0.1f, 2)));
  }
  return data;
}

CaseData huge_soup(std::size_t count, std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  CaseData data{thin_soup(count, random), {}};
  aim_at_triangles(data, ray_count, 1, random);
  return data;
}

}  // namespace umbrix::cases
