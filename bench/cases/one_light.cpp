// SPDX-License-Identifier: Apache-2.0
//
// Many rays to the same light, or from the same points, for tracers that make use of that: past what the light or the
// point sees at the very edge.
#include <cmath>
#include <limits>

#include "cases/families.h"
#include "cases/meshes.h"

namespace umbrix::cases {
namespace {

/// Meshes, sheets in planes across axes, and loose triangles, at sizes of their own.
Triangles seen_scene(Random& random) {
  Triangles all = soup(200, 1, 0.4f, random);
  const auto put = [&](const Triangles& more) { all.insert(all.end(), more.begin(), more.end()); };
  put(icosphere(2, 0.4f, random.chance(0.5) ? 0.3f : 0.0f, random.in_cube(0.5f), random).triangles);
  put(torus(12, 9, 0.5f, 0.15f));
  put(sheet(6, 1, -0.5f));
  if (random.chance(0.5)) put(sheet(1, 0.75f, 0.25f));
  const float size = random.chance(0.5) ? 1.0f : std::ldexp(1.0f, static_cast<int>(random.below(41)) - 20);
  const Float3 offset = random.chance(0.5) ? Float3{0, 0, 0} : random.in_cube(random.magnitude(0, 3));
  for (oracle::Triangle& t : all)
    t = triangle(scale(add(vertex(t, 0), offset), size), scale(add(vertex(t, 1), offset), size),
                 scale(add(vertex(t, 2), offset), size));
  return all;
}

/// Where rays meet: a light, or a point that they start from.
Float3 light_of(OneLight kind, const Triangles& triangles, Random& random) {
  const oracle::Triangle& t = triangles[random.below(triangles.size())];
  const Float3 a = vertex(t, 0), b = vertex(t, 1), c = vertex(t, 2);
  const Float3 other = vertex(triangles[random.below(triangles.size())], random.below(3));
  switch (kind) {
    case OneLight::in_plane:  // of one triangle at least, or of all of a sheet
      if (random.chance(0.5)) return {other[0], other[1], vertex(triangles.back(), 0)[2]};
      return add(a, add(scale(subtract(b, a), random.uniform(-3, 3)), scale(subtract(c, a), random.uniform(-3, 3))));
    case OneLight::at_vertex:
      return a;
    case OneLight::near_triangle:
      return between(between(between(a, b, 0.4f), c, 0.3f), other, random.magnitude(-7, -2));
    case OneLight::far_off:
      return between(a, other, random.sign() * random.magnitude(1, 4));
    default:
      return between(a, other, random.uniform(0, 2));
  }
}

/// How far from a light a start is, for a target at 1: before it, behind it or just there.
float distance_of_start(Random& random) {
  if (random.chance(0.2)) return 1 + random.sign() * random.magnitude(-8, -3);
  return random.chance(0.2) ? random.uniform(0.2f, 1) : random.uniform(1, 3);
}

/// A start that the light sees at the target, or nearly.
Float3 start_at(const Float3& light, const Float3& target, float s, Random& random) {
  Float3 start = between(light, target, s);
  if (random.chance(0.5)) {
    const float far = std::numeric_limits<float>::infinity();
    float& x = start[random.below(3)];
    for (std::size_t steps = random.below(4); steps > 0; --steps) x = std::nextafter(x, random.sign() * far);
  }
  return start;
}

Ray ray_from(const Float3& start, const Float3& light, Random& random) {
  Ray ray = ray_to(start, light, 0, 1);
  if (random.chance(0.5)) {  // normalised, or of any length
    const Float3 d = subtract(light, start);
    float length = std::hypot(d[0], d[1], d[2]);
    if (random.chance(0.2)) length *= random.magnitude(-3, 3);
    for (std::size_t k = 0; k < 3; ++k) ray.direction[k] = d[k] / length;
    ray.tmax = length;
  }
  if (random.chance(0.05)) ray.tmin = ray.tmax * random.uniform(-0.5f, 0.5f);
  if (random.chance(0.02)) ray.tmax *= random.uniform(0.1f, 1.5f);  // ends elsewhere
  return ray;
}

}  // namespace

CaseData to_one_light(OneLight kind, std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  CaseData data{seen_scene(random), {}};
  const Float3 light = light_of(kind, data.triangles, random);
  // From anywhere, or from near each other, as those of pixels.
  const std::size_t run = random.chance(0.3) ? 1 : 8 + random.below(40);
  while (data.rays.size() < ray_count) {
    const oracle::Triangle& aim = data.triangles[random.below(data.triangles.size())];
    const Float3 target = point_on(aim, random);
    const float s = distance_of_start(random);
    data.rays.push_back(ray_from(start_at(light, target, s, random), light, random));
    for (std::size_t k = 1; k < run; ++k) {
      const Float3 near =
          random.chance(0.5) ? target : between(target, point_on(aim, random), random.magnitude(-7, -2.5f));
      const float moved = s + random.sign() * random.magnitude(-9, -2.7f);
      data.rays.push_back(ray_from(start_at(light, near, moved, random), light, random));
    }
  }
  data.rays.resize(ray_count);
  return data;
}

CaseData from_points(OneLight kind, std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  CaseData data{seen_scene(random), {}};
  const Triangles& all = data.triangles;
  while (data.rays.size() < ray_count) {
    // Points near each other, as those that neighbouring pixels see.
    const Float3 middle = light_of(kind, all, random);
    const Float3 other = vertex(all[random.below(all.size())], random.below(3));
    const Float3 spread = scale(subtract(other, middle), random.magnitude(-6, -1));
    const std::size_t aim = random.below(all.size()), wide = 1 + random.below(all.size());
    for (std::size_t points = 1 + random.below(40); points > 0; --points) {
      const Float3 u = random.in_cube(1);
      const Float3 start = random.chance(0.2) ? middle
                                              : Float3{middle[0] + u[0] * spread[0], middle[1] + u[1] * spread[1],
                                                       middle[2] + u[2] * spread[2]};
      for (std::size_t rays = random.chance(0.7) ? 16 : 1 + random.below(20); rays > 0; --rays) {
        const Float3 target = point_on(all[(aim + random.below(wide)) % all.size()], random);
        data.rays.push_back(ray_from(start, start_at(start, target, distance_of_start(random), random), random));
      }
    }
  }
  data.rays.resize(ray_count);
  return data;
}

CaseData from_eyes(OneLight kind, std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  CaseData data{seen_scene(random), {}};
  const Triangles& all = data.triangles;
  while (data.rays.size() < ray_count) {
    const Float3 eye = light_of(kind, all, random);
    for (std::size_t blocks = 1 + random.below(20); blocks > 0; --blocks) {
      const std::size_t aim = random.below(all.size());
      const Float3 lead = point_on(all[aim], random);
      // At any points of three triangles, or so near each other.
      const float nearness = random.chance(0.5) ? 1 : random.magnitude(-6, 0);
      const float tmin = random.chance(0.8) ? 0 : random.uniform(0, 1.5f);
      const float tmax = random.chance(0.5) ? std::numeric_limits<float>::infinity() : random.uniform(0.5f, 3);
      for (std::size_t rays = 16; rays > 0; --rays) {
        const Float3 target = point_on(all[(aim + random.below(3)) % all.size()], random);
        data.rays.push_back(ray_to(eye, between(lead, target, nearness), tmin, tmax));
      }
    }
  }
  data.rays.resize(ray_count);
  return data;
}

}  // namespace umbrix::cases
