// SPDX-License-Identifier: Apache-2.0
//
// The interval is open: a hit exactly at an end does not count, one unit in the last place further in it does.
#include <cmath>
#include <limits>

#include "cases/families.h"
#include "cases/meshes.h"

namespace umbrix::cases {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

float nudge(float x, Random& random) {
  for (std::size_t steps = random.below(3); steps > 0; --steps) x = std::nextafter(x, kInfinity);
  for (std::size_t steps = random.below(3); steps > 0; --steps) x = std::nextafter(x, -kInfinity);
  return x;
}

// Where the ray meets the triangle's plane, rounded.
float plane_time(const Ray& ray, const oracle::Triangle& t) {
  double n[3], numerator = 0, denominator = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    n[i] = (double{t.v[1][j]} - t.v[0][j]) * (double{t.v[2][k]} - t.v[0][k]) -
           (double{t.v[1][k]} - t.v[0][k]) * (double{t.v[2][j]} - t.v[0][j]);
    numerator += n[i] * (double{t.v[0][i]} - ray.origin[i]);
    denominator += n[i] * ray.direction[i];
  }
  return static_cast<float>(numerator / denominator);
}

}  // namespace

CaseData interval_ends(std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  CaseData data;
  // Half of the scenes on a grid with axis-parallel triangles, where t is a float exactly.
  if (random.chance(0.5)) {
    data.triangles = sheet(4, 2, 0.5f);
    const Triangles above = sheet(4, 2, 0.75f);
    data.triangles.insert(data.triangles.end(), above.begin(), above.end());
  } else {
    data.triangles = soup(100, 1, 0.5f, random);
  }
  for (std::size_t i = 0; i < ray_count; ++i) {
    const oracle::Triangle& t = data.triangles[random.below(data.triangles.size())];
    Float3 origin = random.in_cube(2);
    for (float& x : origin) x = std::round(x * 16) / 16;
    Ray ray = ray_to(origin, point_on(t, random), 0, 0);
    const float at = nudge(plane_time(ray, t), random);
    if (random.chance(0.5)) {
      ray.tmax = at;
      ray.tmin = random.chance(0.5) ? 0.0f : -kInfinity;
    } else {
      ray.tmin = at;
      ray.tmax = random.chance(0.5) ? kInfinity : nudge(std::nextafter(at, kInfinity), random);
    }
    data.rays.push_back(ray);
  }
  return data;
}

CaseData random_segments(std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  CaseData data{soup(600, 1, 0.3f, random), {}};
  for (std::size_t i = 0; i < ray_count; ++i) {
    data.rays.push_back(ray_to(random.in_cube(1.2f), random.in_cube(1.2f), 0, 1));
  }
  return data;
}

}  // namespace umbrix::cases
