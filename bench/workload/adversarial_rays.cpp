// SPDX-License-Identifier: Apache-2.0
#include "workload/adversarial_rays.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "cases/random.h"

namespace umbrix::workload {
namespace {

using cases::Random;
using Double3 = std::array<double, 3>;

constexpr double kNearest = 0.005, kFarthest = 0.055;  // of the diagonal

double length(const Double3& a) { return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }

Double3 scaled(const Double3& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }

Double3 sum(const Double3& a, const Double3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

Double3 cross(const Double3& a, const Double3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Double3 corner(const oracle::Triangle& t, std::size_t i) { return {t.v[i][0], t.v[i][1], t.v[i][2]}; }

Double3 edge(const oracle::Triangle& t, std::size_t from) {
  return sum(corner(t, (from + 1) % 3), scaled(corner(t, from), -1));
}

Double3 unit_direction(Random& random) {
  const cases::Float3 d = random.direction();
  const Double3 wide = {d[0], d[1], d[2]};
  return scaled(wide, 1 / length(wide));
}

Double3 point_on_edge(const oracle::Triangle& t, Random& random) {
  const std::size_t from = random.below(3);
  return sum(corner(t, from), scaled(edge(t, from), double{random.uniform(0, 1)}));
}

// Uniform over the triangle (Osada et al. 2002, section 4.2).
Double3 point_inside(const oracle::Triangle& t, Random& random) {
  const double root = std::sqrt(double{random.uniform(0, 1)}), along = random.uniform(0, 1);
  return sum(sum(scaled(corner(t, 0), 1 - root), scaled(corner(t, 1), root * (1 - along))),
             scaled(corner(t, 2), root * along));
}

// A ray between two points, rounded as a renderer rounds: the origin to floats, then the unit direction.
// Returns the distance.
double aim_ray(const Double3& from, const Double3& to, Ray& out) {
  Double3 d;
  for (std::size_t k = 0; k < 3; ++k) {
    out.origin[k] = static_cast<float>(from[k]);
    d[k] = to[k] - out.origin[k];
  }
  const double distance = length(d);
  for (std::size_t k = 0; k < 3; ++k) out.direction[k] = static_cast<float>(d[k] / distance);
  return distance;
}

void set_interval(Ray& ray, double tmin, double tmax) {
  ray.tmin = static_cast<float>(tmin);
  ray.tmax = static_cast<float>(tmax);
}

// None where rounding leaves no such ray.
std::optional<Ray> try_ray(const oracle::Triangle& t, Aim aim, double diagonal, Random& random) {
  Ray ray{};
  const double away = diagonal * (kNearest + (kFarthest - kNearest) * double{random.uniform(0, 1)});
  const Double3 back = scaled(unit_direction(random), -away);
  switch (aim) {
    case Aim::vertex:
    case Aim::edge: {
      const Double3 target = aim == Aim::vertex ? corner(t, random.below(3)) : point_on_edge(t, random);
      const double distance = aim_ray(sum(target, back), target, ray);
      set_interval(ray, 0.999 * distance, 1.001 * distance);
      break;
    }
    case Aim::grazing: {
      const Double3 target = point_inside(t, random), normal = cross(edge(t, 0), edge(t, 1));
      const Double3 along = cross(normal, unit_direction(random));
      const double angle = random.magnitude(-7, -1) * random.sign();
      const Double3 d =
          sum(scaled(along, std::cos(angle) / length(along)), scaled(normal, std::sin(angle) / length(normal)));
      const double distance = aim_ray(sum(target, scaled(d, -away)), target, ray);
      set_interval(ray, 0.5 * distance, 1.5 * distance);
      break;
    }
    case Aim::origin: {
      const std::size_t place = random.below(3);
      const Double3 start = place == 0   ? corner(t, random.below(3))
                            : place == 1 ? point_on_edge(t, random)
                                         : point_inside(t, random);
      set_interval(ray, 0, aim_ray(start, sum(start, back), ray));
      break;
    }
    case Aim::end: {
      const Double3 target = point_inside(t, random);
      const double distance = aim_ray(sum(target, back), target, ray);
      set_interval(ray, 0, 2 * distance);
      const auto hit = oracle::exact_intersection(ray, t.v);
      if (!hit) return std::nullopt;
      auto near_hit = static_cast<float>(hit->t());
      const bool up = random.chance(0.5);
      for (std::size_t steps = random.below(3); steps > 0; --steps)
        near_hit = std::nextafter(near_hit, up ? std::numeric_limits<float>::infinity() : 0.0f);
      set_interval(ray, 0.999 * distance, 1.001 * distance);
      (random.chance(0.5) ? ray.tmin : ray.tmax) = near_hit;
      break;
    }
  }
  const bool finite = std::isfinite(ray.direction[0] + ray.direction[1] + ray.direction[2]);
  if (!finite || !(ray.tmin < ray.tmax)) return std::nullopt;
  return ray;
}

double diagonal_of(const Geometry& geometry) {
  Double3 extent{};
  for (std::size_t k = 0; k < 3; ++k) {
    float low = std::numeric_limits<float>::infinity(), high = -low;
    for (const WorldTriangles& mesh : geometry.meshes) {
      for (const io::Float3& p : mesh.positions) {
        low = std::min(low, p[k]);
        high = std::max(high, p[k]);
      }
    }
    extent[k] = double{high} - low;
  }
  return length(extent);
}

}  // namespace

const char* aim_name(Aim aim) {
  switch (aim) {
    case Aim::vertex:
      return "vertex";
    case Aim::edge:
      return "edge";
    case Aim::grazing:
      return "grazing";
    case Aim::origin:
      return "origin";
    case Aim::end:
      return "end";
  }
  return "";
}

Status adversarial_rays(const Geometry& geometry, Aim aim, std::size_t count, std::uint64_t seed,
                        std::vector<Ray>& out) {
  out.clear();
  const std::vector<oracle::Triangle> triangles = geometry.triangle_list();
  if (triangles.empty()) return {StatusCode::bad_input, fmt::format("{}: no triangles to aim at", geometry.path)};
  const double diagonal = diagonal_of(geometry);
  Random random(seed ^ (static_cast<std::uint64_t>(aim) << 56));
  constexpr std::size_t kTries = 100;
  for (std::size_t tries = 0; out.size() < count && tries < kTries * count; ++tries) {
    const auto ray = try_ray(triangles[random.below(triangles.size())], aim, diagonal, random);
    if (ray) out.push_back(*ray);
  }
  if (out.size() == count) return {};
  return {StatusCode::bad_input, fmt::format("{}: no rays to be had for '{}'", geometry.path, aim_name(aim))};
}

}  // namespace umbrix::workload
