// SPDX-License-Identifier: Apache-2.0
//
// Values that mean nothing, among others that do: those must not suffer.
#include <limits>

#include "cases/families.h"
#include "cases/meshes.h"

namespace umbrix::cases {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

CaseData ball_in_soup(std::size_t ray_count, Random& random) {
  CaseData data{icosphere(1, 1, 0.1f, {0, 0, 0}, random).triangles, {}};
  const Triangles loose = soup(150, 2, 0.4f, random);
  data.triangles.insert(data.triangles.end(), loose.begin(), loose.end());
  for (std::size_t i = 0; i < ray_count; ++i) {
    const Float3 target = point_on(data.triangles[random.below(data.triangles.size())], random);
    data.rays.push_back(ray_to(random.in_cube(3), target, 0, random.chance(0.3) ? 1.0f : random.uniform(0.5f, 4)));
  }
  return data;
}

float bad_coordinate(Random& random) {
  const float values[] = {kNaN, kInfinity, -kInfinity, std::numeric_limits<float>::denorm_min()};
  return values[random.below(4)];
}

}  // namespace

CaseData invalid_vertices(std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  CaseData data = ball_in_soup(ray_count, random);
  const bool all = random.chance(0.05);
  for (oracle::Triangle& t : data.triangles) {
    if (all || random.chance(0.1)) t.v[random.below(3)][random.below(3)] = all ? kNaN : bad_coordinate(random);
  }
  return data;
}

CaseData invalid_rays(std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  CaseData data = ball_in_soup(ray_count, random);
  for (Ray& ray : data.rays) {
    switch (random.below(12)) {
      case 0:
        ray.origin[random.below(3)] = bad_coordinate(random);
        break;
      case 1:
        ray.direction[random.below(3)] = bad_coordinate(random);
        break;
      case 2:
        for (float& x : ray.direction) x = 0.0f * random.sign();
        break;
      case 3:
        for (float& x : ray.direction) x *= 1e-40f;
        ray.tmax = kInfinity;
        break;
      case 4:
        ray.tmin = kNaN;
        break;
      case 5:
        ray.tmax = kNaN;
        break;
      case 6:
        std::swap(ray.tmin, ray.tmax);
        break;
      case 7:
        ray.tmin = ray.tmax;
        break;
      case 8:
        ray.tmin = -kInfinity;
        break;
      case 9:
        ray.tmin = random.chance(0.5) ? kInfinity : -kInfinity;
        ray.tmax = random.chance(0.5) ? kInfinity : -kInfinity;
        break;
      default:
        break;
    }
  }
  return data;
}

}  // namespace umbrix::cases
