// SPDX-License-Identifier: Apache-2.0
//
// The same kinds of scene at other sizes and places: nothing may depend on an absolute epsilon.
#include <cmath>
#include <limits>

#include "cases/families.h"
#include "cases/meshes.h"

namespace umbrix::cases {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// A sphere on a floor with some loose triangles, about 4 wide, and rays among them.
CaseData still_life(std::size_t ray_count, Random& random) {
  CaseData data{icosphere(1, 1, 0.1f, {0, 0, 0}, random).triangles, {}};
  const Triangles floor = sheet(4, 2, -1), loose = soup(60, 2, 0.5f, random);
  data.triangles.insert(data.triangles.end(), floor.begin(), floor.end());
  data.triangles.insert(data.triangles.end(), loose.begin(), loose.end());
  for (std::size_t i = 0; i < ray_count; ++i) {
    const Float3 target = point_on(data.triangles[random.below(data.triangles.size())], random);
    data.rays.push_back(ray_to(random.in_cube(2), target, 0, random.chance(0.5) ? 1.0f : random.uniform(0.5f, 4)));
  }
  return data;
}

// Scales space; t keeps its meaning because the direction is scaled as well.
void scale_space(CaseData& data, float s) {
  for (oracle::Triangle& t : data.triangles) {
    for (auto& corner : t.v) {
      for (float& x : corner) x *= s;
    }
  }
  for (Ray& ray : data.rays) {
    for (float& x : ray.origin) x *= s;
    for (float& x : ray.direction) x *= s;
  }
}

constexpr double kScaleExponents[] = {-18, -12, -6, 0, 6, 12, 18};

}  // namespace

CaseData scaled_power_of_two(std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  CaseData data = still_life(ray_count, random);
  const double exponent = std::round(kScaleExponents[random.below(7)] * std::log2(10.0));
  scale_space(data, std::ldexp(1.0f, static_cast<int>(exponent)));
  return data;
}

CaseData scaled_any(std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  CaseData data = still_life(ray_count, random);
  scale_space(data, static_cast<float>(std::pow(10.0, kScaleExponents[random.below(7)])) * random.uniform(0.5f, 1.5f));
  // Hosts normalise directions.
  if (random.chance(0.5)) {
    for (Ray& ray : data.rays) {
      const double length = std::hypot(double{ray.direction[0]}, double{ray.direction[1]}, double{ray.direction[2]});
      if (length == 0) continue;
      for (float& x : ray.direction) x = static_cast<float>(x / length);
      ray.tmax = static_cast<float>(ray.tmax * length);
    }
  }
  return data;
}

CaseData translated(std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  const float distances[] = {1e2f, 1e4f, 1e6f};
  const Float3 offset = scale(random.direction(), 8 * distances[random.below(3)]);
  CaseData data = still_life(0, random);
  for (oracle::Triangle& t : data.triangles) {
    for (auto& corner : t.v) {
      for (std::size_t k = 0; k < 3; ++k) corner[k] += offset[k];
    }
  }
  for (std::size_t i = 0; i < ray_count; ++i) {
    const Float3 target = point_on(data.triangles[random.below(data.triangles.size())], random);
    const Float3 origin = add(offset, random.in_cube(2));
    data.rays.push_back(ray_to(origin, target, 0, random.chance(0.5) ? 1.0f : random.uniform(0.5f, 4)));
  }
  return data;
}

CaseData mixed_scale(std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  const Float3 place = random.in_cube(0.5f);
  CaseData data{icosphere(2, 1e-6f, 0.2f, place, random).triangles, {}};
  const std::size_t small = data.triangles.size();
  const Triangles stadium = soup(150, 1, 0.5f, random);
  data.triangles.insert(data.triangles.end(), stadium.begin(), stadium.end());
  for (std::size_t i = 0; i < ray_count; ++i) {
    const std::size_t among = random.chance(0.7) ? small : data.triangles.size();
    const Float3 target = point_on(data.triangles[random.below(among)], random);
    const Float3 origin = random.chance(0.5) ? random.in_cube(2) : add(place, random.in_cube(3e-6f));
    data.rays.push_back(ray_to(origin, target, 0, random.chance(0.5) ? 1.0f : kInfinity));
  }
  return data;
}

CaseData whole_float_range(std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  CaseData data = still_life(ray_count, random);
  if (random.chance(0.3)) {  // every coordinate at a size of its own
    for (oracle::Triangle& t : data.triangles) {
      for (auto& corner : t.v) {
        for (float& x : corner) x *= random.magnitude(-30, 30);
      }
    }
    for (std::size_t i = 0; i < data.rays.size(); ++i) {
      const Float3 target = point_on(data.triangles[random.below(data.triangles.size())], random);
      data.rays[i] = ray_to(scale(random.in_cube(1), random.magnitude(-30, 30)), target, 0, random.uniform(0.5f, 4));
    }
    return data;
  }
  // In two steps, since a denormal factor would have few bits.
  const int exponent = static_cast<int>(random.below(273)) - 149;
  scale_space(data, std::ldexp(1.0f, exponent / 2));
  scale_space(data, std::ldexp(1.0f, exponent - exponent / 2));
  return data;
}

CaseData far_origins(std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  CaseData data = still_life(0, random);
  for (std::size_t i = 0; i < ray_count; ++i) {
    const Float3 target = point_on(data.triangles[random.below(data.triangles.size())], random);
    const Float3 away = scale(random.direction(), 4 * random.magnitude(1, 12));
    Ray ray = ray_to(add(target, away), target, 0, random.chance(0.5) ? 2.0f : kInfinity);
    if (random.chance(0.2)) ray.direction[random.below(3)] = 0;
    data.rays.push_back(ray);
  }
  return data;
}

}  // namespace umbrix::cases
