// SPDX-License-Identifier: Apache-2.0
//
// Rays as a renderer makes them: from a rounded point of a surface, moved off it by offset_origin, to a light.
#include <algorithm>
#include <cmath>
#include <limits>

#include "cases/families.h"
#include "cases/meshes.h"
#include "umbrix/scene.h"

namespace umbrix::cases {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct SurfacePoint {
  Float3 point;
  Float3 error;
  Float3 normal;
};

// As Pharr, Jakob & Humphreys (2023), section 6.8.5, in double: half a unit in the last place for the rounding to
// float, and more than the double sums' own.
SurfacePoint surface_point(const oracle::Triangle& t, double b1, double b2) {
  SurfacePoint result;
  double e1[3], e2[3], n[3];
  for (std::size_t k = 0; k < 3; ++k) {
    const double p0 = t.v[0][k], p1 = t.v[1][k], p2 = t.v[2][k];
    const double sum = (1 - b1 - b2) * p0 + b1 * p1 + b2 * p2;
    const double terms = std::abs(p0) + std::abs(p1) + std::abs(p2);
    result.point[k] = static_cast<float>(sum);
    result.error[k] = std::nextafter(static_cast<float>(std::abs(sum) * 0x1p-24 + terms * 0x1p-49), kInfinity);
    e1[k] = p1 - p0;
    e2[k] = p2 - p0;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    n[k] = e1[i] * e2[j] - e1[j] * e2[i];
  }
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  for (std::size_t k = 0; k < 3; ++k) result.normal[k] = static_cast<float>(length > 0 ? n[k] / length : 0);
  return result;
}

// Within, on an edge or at a corner.
SurfacePoint surface_point(const oracle::Triangle& t, Random& random) {
  const std::size_t kind = random.below(4);
  const double u = random.uniform(0, 1), v = random.uniform(0, 1);
  const double corners[3][2] = {{0, 0}, {1, 0}, {0, 1}};
  if (kind == 0) {
    const auto& corner = corners[random.below(3)];
    return surface_point(t, corner[0], corner[1]);
  }
  if (kind == 1) return surface_point(t, u, 1 - u);
  return u + v > 1 ? surface_point(t, 1 - u, 1 - v) : surface_point(t, u, v);
}

Float3 moved_off(const SurfacePoint& p, const Float3& toward) {
  Float3 origin;
  offset_origin(p.point.data(), p.error.data(), p.normal.data(), toward.data(), origin.data());
  return origin;
}

double dot(const Float3& a, const Float3& b) { return double{a[0]} * b[0] + double{a[1]} * b[1] + double{a[2]} * b[2]; }

// A ball, a floor and loose triangles.
Triangles shaded_scene(Random& random) {
  Triangles result = icosphere(2, 1, 0, {0, 0, 0}, random).triangles;
  const Triangles floor = sheet(4, 3, -1.25f), loose = soup(40, 2, 0.5f, random);
  result.insert(result.end(), floor.begin(), floor.end());
  result.insert(result.end(), loose.begin(), loose.end());
  return result;
}

// A rotation that leaves no wall parallel to an axis.
constexpr float kTurn[3][3] = {{0.64f, 0.48f, -0.6f}, {-0.6f, 0.8f, 0}, {0.48f, 0.36f, 0.8f}};

// A turned cube; neighbours share vertices bit for bit.
Triangles box(float half_size, const Float3& center) {
  constexpr int kCells = 4;
  Triangles result;
  for (const float side : {-1.0f, 1.0f}) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (oracle::Triangle t : sheet(kCells, 1, side)) {
        for (auto& corner : t.v) {
          std::rotate(corner, corner + axis, corner + 3);
          Float3 turned = center;
          for (std::size_t k = 0; k < 3; ++k) {
            turned[k] += half_size * (kTurn[k][0] * corner[0] + kTurn[k][1] * corner[1] + kTurn[k][2] * corner[2]);
          }
          std::copy(turned.begin(), turned.end(), corner);
        }
        result.push_back(t);
      }
    }
  }
  return result;
}

struct Room {
  float half_size;
  Float3 center;
};

Room any_room(Random& random) {
  const float half_size = random.magnitude(-3, 3);
  return {half_size, random.chance(0.5) ? Float3{0, 0, 0} : scale(random.in_cube(1), 8 * half_size)};
}

// Whether a point on a turned box's wall is at an edge of the box, where another wall may be nearer than an offset.
bool is_at_box_edge(const Float3& point, const Room& room) {
  int walls = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double along = 0;
    for (std::size_t k = 0; k < 3; ++k) along += kTurn[k][axis] * (double{point[k]} - room.center[k]);
    walls += std::abs(along) > room.half_size * (1 - 1e-4) ? 1 : 0;
  }
  return walls > 1;
}

enum class Where { anywhere, off_edges, at_edges };

// From points of a room's walls to points well outside it.
CaseData through_walls(Triangles triangles, std::size_t walls, const Room& room, Where where, bool outward,
                       std::size_t ray_count, Random& random) {
  CaseData data{std::move(triangles), {}};
  while (data.rays.size() < ray_count) {
    const SurfacePoint p = surface_point(data.triangles[random.below(walls)], random);
    if (where != Where::anywhere && is_at_box_edge(p.point, room) != (where == Where::at_edges)) continue;
    const Float3 out = subtract(p.point, room.center);
    const Float3 origin = moved_off(p, outward ? out : scale(out, -1));
    const Float3 light = add(room.center, scale(random.direction(), random.magnitude(3, 4) * room.half_size));
    data.rays.push_back(ray_to(origin, light, 0, 1));
  }
  return data;
}

}  // namespace

CaseData offset_outward(std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  const ClosedMesh ball = icosphere(3, 1, 0, {0, 0, 0}, random);
  CaseData data{ball.triangles, {}};
  for (std::size_t i = 0; i < ray_count; ++i) {
    const SurfacePoint p = surface_point(ball.triangles[random.below(ball.triangles.size())], random);
    const Float3 origin = moved_off(p, p.point);
    // Less than 60 degrees from the direction of the point: in front of all triangles round it.
    const Float3 aside = random.in_cube(0.45f);
    data.rays.push_back(ray_to(origin, add(origin, add(p.point, aside)), 0, random.chance(0.5) ? 1.0f : kInfinity));
  }
  return data;
}

CaseData offset_inward(std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  const ClosedMesh ball = icosphere(3, 1, 0, {0, 0, 0}, random);
  CaseData data{ball.triangles, {}};
  for (std::size_t i = 0; i < ray_count; ++i) {
    const SurfacePoint p = surface_point(ball.triangles[random.below(ball.triangles.size())], random);
    const Float3 origin = moved_off(p, scale(p.point, -1));
    data.rays.push_back(ray_to(origin, scale(random.direction(), 300), 0, random.chance(0.5) ? 1.0f : kInfinity));
  }
  return data;
}

CaseData light_at(LightPlace place, std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  CaseData data{shaded_scene(random), {}};
  const auto any = [&]() -> const oracle::Triangle& { return data.triangles[random.below(data.triangles.size())]; };
  for (std::size_t i = 0; i < ray_count; ++i) {
    Float3 light = random.in_cube(0.5f);  // within the ball
    switch (place) {
      case LightPlace::on_face:
        light = between(between(vertex(any(), 0), vertex(any(), 1), 0.4f), vertex(any(), 2), 0.3f);
        if (random.chance(0.8)) light = surface_point(any(), 0.3, 0.4).point;
        break;
      case LightPlace::at_vertex:
        light = vertex(any(), random.below(3));
        break;
      case LightPlace::on_edge: {
        const oracle::Triangle& t = any();
        light = between(vertex(t, 0), vertex(t, 1), random.chance(0.5) ? 0.5f : random.uniform(0, 1));
        break;
      }
      case LightPlace::on_split_plane:
        light[random.below(3)] = vertex(any(), random.below(3))[random.below(3)];
        break;
      case LightPlace::outside:
        light = scale(random.direction(), 3 * random.magnitude(0, 6));
        break;
      case LightPlace::directional:
        light = scale(random.direction(), 1e30f);
        break;
      default:
        break;
    }
    const SurfacePoint p = surface_point(any(), random);
    data.rays.push_back(ray_to(moved_off(p, subtract(light, p.point)), light, 0, 1));
  }
  return data;
}

CaseData no_distance(std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  CaseData data{shaded_scene(random), {}};
  for (std::size_t i = 0; i < ray_count; ++i) {
    const SurfacePoint p = surface_point(data.triangles[random.below(data.triangles.size())], random);
    Float3 light = p.point;
    if (random.chance(0.8)) {  // up to one unit in the last place away on each axis
      for (float& x : light) {
        const float toward[] = {-kInfinity, x, kInfinity};
        x = std::nextafter(x, toward[random.below(3)]);
      }
    }
    const Float3 origin = random.chance(0.5) ? p.point : moved_off(p, p.normal);
    data.rays.push_back(ray_to(origin, light, 0, random.chance(0.7) ? 1.0f : kInfinity));
  }
  return data;
}

// Nothing is in front of a convex mesh's triangle: no point in front of it may be shadowed.
CaseData convex_in_front(std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  const float radius = random.magnitude(-3, 3);
  const Float3 center = random.chance(0.5) ? Float3{0, 0, 0} : scale(random.in_cube(1), 8 * radius);
  CaseData data{icosphere(static_cast<int>(random.below(4)), radius, 0, center, random).triangles, {}};
  while (data.rays.size() < ray_count) {
    const SurfacePoint p = surface_point(data.triangles[random.below(data.triangles.size())], random);
    const Float3 light = add(center, scale(random.direction(), radius * random.magnitude(1, 3)));
    const Float3 to_light = subtract(light, p.point);
    // Lights in the plane but for rounding are on neither side.
    const Float3 out = dot(p.normal, subtract(p.point, center)) > 0 ? p.normal : scale(p.normal, -1);
    if (dot(out, to_light) < 1e-4 * std::sqrt(dot(to_light, to_light))) continue;
    data.rays.push_back(ray_to(moved_off(p, to_light), light, 0, 1));
  }
  return data;
}

namespace {

CaseData single_walls(Where where, std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  const Room room = any_room(random);
  const Triangles walls = box(room.half_size, room.center);
  return through_walls(walls, walls.size(), room, where, false, ray_count, random);
}

}  // namespace

CaseData inside_single_walls(std::uint64_t seed, std::size_t ray_count) {
  return single_walls(Where::off_edges, seed, ray_count);
}

CaseData inside_single_wall_edges(std::uint64_t seed, std::size_t ray_count) {
  return single_walls(Where::at_edges, seed, ray_count);
}

CaseData inside_thin_walls(float thickness, std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  const Room room = any_room(random);
  Triangles walls = box(room.half_size, room.center);
  const std::size_t inner = walls.size();
  // The largest offset of any point of the walls.
  float offset = 0;
  for (const oracle::Triangle& t : walls) {
    for (int corner = 0; corner < 3; ++corner) {
      const SurfacePoint p = surface_point(t, corner == 1 ? 1 : 0, corner == 2 ? 1 : 0);
      const Float3 moved = subtract(moved_off(p, subtract(p.point, room.center)), p.point);
      offset = std::max(offset, static_cast<float>(std::sqrt(dot(moved, moved))));
    }
  }
  const Triangles outer = box(room.half_size + thickness * offset, room.center);
  walls.insert(walls.end(), outer.begin(), outer.end());
  return through_walls(std::move(walls), inner, room, Where::anywhere, true, ray_count, random);
}

}  // namespace umbrix::cases
