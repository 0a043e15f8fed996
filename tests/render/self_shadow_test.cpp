// SPDX-License-Identifier: Apache-2.0
// What the renderer's shadow rays start with: no surface shadows itself, and no closed one lets light in, at any size
// and however far from the origin of coordinates, where floats are coarse.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "built_scenes.h"
#include "convex_mesh.h"
#include "render/camera.h"
#include "traced.h"

namespace umbrix::render {
namespace {

/// How far from the origin, in units of the mesh's size: about 2^distance. There a float's spacing is 1, so the mesh is
/// the smaller the farther it is.
struct Site {
  int distance;
  std::int64_t radius;
  Int3 base;
};
constexpr Site kSites[] = {{0, 1 << 18, {0, 0, 0}},
                           {7, 1 << 15, {12582912, -12582907, 10485837}},
                           {14, 1 << 8, {12582912, -12582907, 10485837}},
                           {20, 1 << 2, {12582912, -12582907, 10485837}}};

class Shapes {
 public:
  explicit Shapes(unsigned seed) : random_(seed) {}

  double uniform() { return std::uniform_real_distribution<double>(-1, 1)(random_); }
  std::size_t below(std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_); }
  Vec3 direction() {
    const Vec3 v(uniform(), uniform(), uniform());
    return glm::normalize(v);
  }

  ConvexMesh cube(std::int64_t radius) {
    std::vector<Int3> points;
    for (int corner = 0; corner < 8; ++corner) {
      points.push_back({corner & 1 ? radius : -radius, corner & 2 ? radius : -radius, corner & 4 ? radius : -radius});
    }
    return convex_hull(points);
  }

  /// The hull of points of a sphere, flattened to `height`.
  ConvexMesh round(std::int64_t radius, int count, double height = 1) {
    std::vector<Int3> points;
    for (int i = 0; i < count; ++i) points.push_back(rounded(direction() * Vec3(1, 1, height), radius));
    return convex_hull(points);
  }

  /// A regular one, turned at random: its faces meet at 70 degrees.
  ConvexMesh tetrahedron(std::int64_t radius) {
    const Vec3 x = direction(), y = glm::normalize(glm::cross(x, direction())), z = glm::cross(x, y);
    return convex_hull({rounded((x + y + z) / std::sqrt(3.0), radius), rounded((x - y - z) / std::sqrt(3.0), radius),
                        rounded((y - x - z) / std::sqrt(3.0), radius), rounded((z - x - y) / std::sqrt(3.0), radius)});
  }

  static Int3 rounded(const Vec3& v, std::int64_t radius) {
    Int3 result;
    for (int k = 0; k < 3; ++k) result[static_cast<std::size_t>(k)] = std::llround(v[k] * static_cast<double>(radius));
    return result;
  }

 private:
  std::mt19937_64 random_;
};

Vec3 to_world(const Int3& point, const Int3& base, int exponent) {
  Vec3 result;
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    result[k] = std::ldexp(static_cast<double>(base[axis] + point[axis]), exponent);
  }
  return result;
}

io::Camera camera_towards(const Vec3& eye, const Vec3& forward, double yfov) {
  const Vec3 right = glm::normalize(glm::cross(forward, std::abs(forward.x) < 0.9 ? Vec3(1, 0, 0) : Vec3(0, 1, 0)));
  const Vec3 up = glm::cross(right, forward);
  io::Camera camera;
  camera.yfov = yfov;
  for (int k = 0; k < 3; ++k) camera.to_world[static_cast<std::size_t>(k)] = {right[k], up[k], -forward[k], eye[k]};
  return camera;
}

struct Tally {
  std::uint64_t rays = 0, occluded = 0;
};

/// Looks at the world and on to the light from each surface that faces it; `counts` decides by triangle.
template <class Counts>
void look(const World& world, const io::Camera& described, int pixels, const Vec3& light, const Counts& counts,
          Tally& tally) {
  const Camera camera(described, pixels, pixels);
  const io::Light lamp = point_light({light.x, light.y, light.z}, 1);
  for (int i = 0; i < pixels * pixels; ++i) {
    const Ray ray = camera.ray(i % pixels + 0.5, i / pixels + 0.5);
    Hit hit;
    if (!world.scene.closest(ray, hit) || !counts(hit.primitive.triangle)) continue;
    const Surface surface = surface_at(world, ray, hit);
    const Receiver receiver = receiver_at(surface);
    const Arrival arrival = make_light(lamp, world)->sample(receiver, {});
    if (glm::dot(surface.geometric_normal, arrival.to_light) <= 0) continue;
    QueryOptions query;
    query.skip = &surface.primitive;
    ++tally.rays;
    tally.occluded += world.scene.occluded(shadow_ray(receiver, arrival), query);
  }
}

/// The mesh as a scene of its own.
struct Placed {
  Placed(const ConvexMesh& mesh, const Site& site, int exponent, const io::Transform& transform = io::kIdentity)
      : scene(scene_of(mesh.placed(site.base, exponent))) {
    place(scene, 0, transform);
    const Status status = build_world(scene, {}, world);
    EXPECT_TRUE(status.ok()) << status.message();
  }
  io::SceneFile scene;
  World world;
};

/// Sends rays to all sides of a convex mesh from outside; the light is outside as well.
Tally self_shadow(Shapes& shapes, const ConvexMesh& mesh, const Site& site, int exponent) {
  const Placed placed(mesh, site, exponent);
  Tally tally;
  for (int view = 0; view < 8; ++view) {
    const Vec3 away = shapes.direction();
    const Vec3 eye = to_world(Shapes::rounded(away, 4 * site.radius), site.base, exponent);
    const Int3 light = Shapes::rounded(shapes.direction(), 6 * site.radius);
    look(
        placed.world, camera_towards(eye, -away, 0.7), 24, to_world(light, site.base, exponent),
        [&](std::uint32_t triangle) { return mesh.in_front(triangle, light); }, tally);
  }
  return tally;
}

TEST(SelfShadow, ConvexMeshesDoNotShadowTheirLitSide) {
  constexpr unsigned kSeed = 3;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  Shapes shapes(kSeed);
  for (const Site& site : kSites) {
    for (const int exponent : {-78, -30, 0, 40}) {  // sizes from 1e-18 to 1e18
      for (const ConvexMesh& mesh : {shapes.cube(site.radius), shapes.round(site.radius, 20),
                                     shapes.round(site.radius, 20, 0.02), shapes.round(site.radius, 5)}) {
        if (mesh.triangles.size() < 4) continue;
        SCOPED_TRACE("2^" + std::to_string(site.distance) + " sizes away, scale 2^" + std::to_string(exponent));
        const Tally tally = self_shadow(shapes, mesh, site, exponent);
        ASSERT_EQ(tally.occluded, 0u) << "of " << tally.rays;
      }
    }
  }
}

TEST(SelfShadow, InstancesDoNotShadowTheirLitSide) {
  constexpr unsigned kSeed = 4;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  Shapes shapes(kSeed);
  const Site& site = kSites[0];
  Tally tally;
  for (int i = 0; i < 20; ++i) {
    // Rotated, stretched unevenly, and moved: each vertex is rounded, yet the mesh stays convex. Its faces are
    // triangles.
    const Vec3 x = shapes.direction(), y = glm::normalize(glm::cross(x, shapes.direction())), z = glm::cross(x, y);
    const Vec3 stretch(1e-6, 1e-6 * (2 + shapes.uniform()), i % 2 == 0 ? -4e-7 : 3e-7);
    io::Transform transform;
    for (int k = 0; k < 3; ++k) {
      transform[static_cast<std::size_t>(k)] = {x[k] * stretch.x, y[k] * stretch.y, z[k] * stretch.z, 10 * x[k]};
    }
    const ConvexMesh mesh = shapes.round(site.radius, 12);
    const Placed placed(mesh, site, 0, transform);
    const Vec3 centre = 10.0 * x, away = shapes.direction();
    const Int3 light = Shapes::rounded(shapes.direction(), 6 * site.radius);
    Vec3 light_there = centre;
    for (int k = 0; k < 3; ++k) {
      light_there += (k == 0   ? x
                      : k == 1 ? y
                               : z) *
                     stretch[k] * static_cast<double>(light[static_cast<std::size_t>(k)]);
    }
    look(
        placed.world, camera_towards(centre + 2.0 * away, -away, 0.5), 80, light_there,
        [&](std::uint32_t triangle) { return mesh.in_front(triangle, light); }, tally);
  }
  EXPECT_GT(tally.rays, 2000u);
  EXPECT_EQ(tally.occluded, 0u);
}

/// From inside to an outer light: to all sides, and at edges from so near that neighbouring pixels share floats.
Tally light_inside(Shapes& shapes, const ConvexMesh& mesh, const Site& site, int exponent) {
  const Placed placed(mesh, site, exponent);
  const auto all = [](std::uint32_t) { return true; };
  Int3 centre = {0, 0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    for (const Int3& point : mesh.points) centre[k] += point[k];
    centre[k] /= static_cast<std::int64_t>(mesh.points.size());
  }
  const Vec3 eye = to_world(centre, site.base, exponent);
  const double spacing = std::ldexp(site.distance == 0 ? static_cast<double>(site.radius) * 0x1p-23 : 1.0, exponent);
  Tally tally;
  for (int view = 0; view < 24; ++view) {
    const Vec3 light = to_world(Shapes::rounded(shapes.direction(), 6 * site.radius), site.base, exponent);
    look(placed.world, camera_towards(eye, shapes.direction(), 2.5), 8, light, all, tally);
    const auto& [first, second, third] = mesh.triangles[shapes.below(mesh.triangles.size())];
    const double part = 0.5 + 0.5 * shapes.uniform();
    const Vec3 edge = part * to_world(mesh.points[first], site.base, exponent) +
                      (1 - part) * to_world(mesh.points[second], site.base, exponent) - eye;
    look(placed.world, camera_towards(eye, glm::normalize(edge), std::min(2.0, 6 * spacing / glm::length(edge))), 16,
         light, all, tally);
  }
  return tally;
}

TEST(LightLeak, ClosedMeshesLetNoLightIn) {
  constexpr unsigned kSeed = 5;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  Shapes shapes(kSeed);
  for (const Site& site : kSites) {
    for (const int exponent : {-78, 0, 40}) {
      std::vector<ConvexMesh> meshes = {shapes.cube(site.radius)};
      // A sharper mesh of a few floats' size has no room for a point inside.
      if (site.distance < 20) {
        meshes.push_back(shapes.round(site.radius, 20));
        meshes.push_back(shapes.tetrahedron(site.radius));
      }
      for (const ConvexMesh& mesh : meshes) {
        SCOPED_TRACE("2^" + std::to_string(site.distance) + " sizes away, scale 2^" + std::to_string(exponent) + ", " +
                     std::to_string(mesh.points.size()) + " points");
        const Tally tally = light_inside(shapes, mesh, site, exponent);
        ASSERT_GT(tally.rays, 500u);
        ASSERT_EQ(tally.occluded, tally.rays);
      }
    }
  }
}

/// A floor of two triangles and a wall of two sheets on it, `thickness` apart, turned by the axes and moved.
io::SceneFile wall_on_a_floor(const Vec3 axes[3], const Vec3& base, double thickness) {
  const auto at = [&](double x, double y, double z) {
    const Vec3 p = base + x * axes[0] + y * axes[1] + z * axes[2];
    return io::Float3{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
  };
  io::SceneFile scene = scene_of(quad(at(-3, -2.7, 0), at(2.9, -3.1, 0), at(3.3, 3, 0), at(-2.8, 3.2, 0)));
  for (const double x : {0.1, 0.1 + thickness}) {
    scene.meshes.push_back(quad(at(x, -1, -0.5), at(x, 1, -0.5), at(x, 1, 2), at(x, -1, 2)));
  }
  for (std::uint32_t mesh = 0; mesh < 3; ++mesh) place(scene, mesh);
  return scene;
}

// Where a wall stands on a floor that goes on below it, rounding may move a ray's start through the first of its
// sheets, but not through both. Measured with walls of all thicknesses: the thickest that leaks has 2.5 offsets.
TEST(LightLeak, WallsOfFourOffsetsHold) {
  constexpr unsigned kSeed = 6;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  Shapes shapes(kSeed);
  for (const double distance : {0.0, 1e2, 1e4}) {
    SCOPED_TRACE(distance);
    const double spacing = 0x1p-23 * std::max(1.0, distance);
    constexpr double kLargestOffset = 1.6;  // in spacings
    for (int i = 0; i < 20; ++i) {
      Vec3 axes[3] = {shapes.direction()};
      axes[1] = glm::normalize(glm::cross(axes[0], shapes.direction()));
      axes[2] = glm::cross(axes[0], axes[1]);
      const Vec3 base = distance * Vec3(0.6, 0.5, 0.62);
      const io::SceneFile scene = wall_on_a_floor(axes, base, 4 * kLargestOffset * spacing);
      World world;
      ASSERT_TRUE(build_world(scene, {}, world).ok());
      const Vec3 eye = base - 0.5 * axes[0] + 0.3 * axes[2], light = base + 3.0 * axes[0] + 0.5 * axes[2];
      const Vec3 foot = base + 0.1 * axes[0] + 0.3 * shapes.uniform() * axes[1];
      Tally tally;
      look(
          world, camera_towards(eye, glm::normalize(foot - eye), std::min(1.0, 12 * spacing)), 24, light,
          [](std::uint32_t) { return true; }, tally);
      ASSERT_EQ(tally.occluded, tally.rays);
    }
  }
}

}  // namespace
}  // namespace umbrix::render
