// SPDX-License-Identifier: Apache-2.0
// Where shadow rays end: a light is never in its own way, whatever lies on it is not either, and what is in front of it
// is. Random lights of all sizes, at all distances from the origin.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "built_scenes.h"
#include "light_estimates.h"
#include "traced.h"

namespace umbrix::render {
namespace {

constexpr unsigned kSeed = 31;
constexpr int kScenes = 3000, kRays = 64;

using Sheet = std::vector<io::Float3>;  // corners of triangles

/// Triangles around a middle, about `size` wide: as a flat fan, or with a bulge.
Sheet random_sheet(std::mt19937_64& random, const Vec3& middle, double size, double bulge) {
  const Vec3 normal = unit_vector(random), u = glm::normalize(glm::cross(normal, unit_vector(random)));
  const Vec3 v = glm::cross(normal, u);
  std::uniform_real_distribution<double> radius(0.3, 1);
  constexpr int kCorners = 5;
  std::vector<io::Float3> rim;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * kPi * i / kCorners, r = size * radius(random);
    rim.emplace_back();
    store(middle + r * std::cos(angle) * u + r * std::sin(angle) * v - bulge * size * normal, rim.back().data());
  }
  io::Float3 top;
  store(middle, top.data());
  Sheet sheet;
  for (std::size_t i = 0; i < kCorners; ++i) sheet.insert(sheet.end(), {top, rim[i], rim[(i + 1) % kCorners]});
  return sheet;
}

io::Mesh mesh_of(const Sheet& corners) {
  io::Mesh mesh;
  mesh.positions = corners;
  for (std::uint32_t i = 0; i < corners.size(); i += 3) mesh.triangles.push_back({i, i + 1, i + 2});
  return mesh;
}

/// A double-sided lamp of such triangles, and a light for it.
struct Lamp {
  io::SceneFile file;
  World world;
  std::unique_ptr<Light> light;

  void build() {
    ASSERT_TRUE(build_world(file, {}, world).ok());
    light = make_light(io::emissive_lights(file).at(0), world);
  }
};

void make_lamp(const Sheet& sheet, Lamp& lamp) {
  lamp.file = scene_of(mesh_of(sheet));
  lamp.file.materials.resize(2);
  lamp.file.materials[0].emission = {1, 1, 1};
  lamp.file.materials[0].double_sided = true;
  place(lamp.file, 0);
}

/// Scale and place of a case: from 2^-20 to 2^20 wide, up to 2^12 times its width away from the origin.
struct Setting {
  double size;
  Vec3 middle;
};

Setting random_setting(std::mt19937_64& random) {
  const auto power = [&](int low, int high) {
    return std::ldexp(1.0, std::uniform_int_distribution(low, high)(random));
  };
  const double size = power(-20, 20);
  return {size, unit_vector(random) * (size * power(-4, 12))};
}

/// As a surface's origin is. GCC 12 leaves out a rounding that is undone at once, so it must be kept from seeing that.
Vec3 rounded(const Vec3& v) {
  volatile float kept[3];
  for (int axis = 0; axis < 3; ++axis) kept[axis] = static_cast<float>(v[axis]);
  return Vec3(kept[0], kept[1], kept[2]);
}

/// A point that may see the light: near to far away.
Vec3 random_origin(std::mt19937_64& random, const Setting& setting) {
  const double distance = setting.size * std::pow(10, std::uniform_real_distribution(-2.0, 3.0)(random));
  return rounded(setting.middle + distance * unit_vector(random));
}

SamplePoint random_point(std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  const double x = uniform(random);
  return {x, uniform(random)};
}

TEST(ShadowRay, EmissiveMeshIsNeverInItsOwnWay) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937_64 random(kSeed);
  int traced = 0;
  for (int scene = 0; scene < kScenes; ++scene) {
    const Setting setting = random_setting(random);
    // Flat: its back shines as well. Bulging: seen from above, where no part hides another.
    const bool flat = scene % 2 == 0;
    Lamp lamp;
    make_lamp(random_sheet(random, setting.middle, setting.size, flat ? 0 : 0.3), lamp);
    lamp.file.materials[0].double_sided = flat;
    lamp.build();
    for (int i = 0; i < kRays; ++i) {
      const Vec3 origin = random_origin(random, setting);
      const Receiver at = receiver(origin, Vec3(0, 0, 1));
      const Arrival arrival = lamp.light->sample(at, random_point(random));
      if (arrival.unreached != Unreached::no) continue;
      ++traced;
      ASSERT_FALSE(lamp.world.scene.occluded(shadow_ray(at, arrival))) << "scene " << scene << " ray " << i;
    }
  }
  EXPECT_GT(traced, kScenes * kRays / 2);
}

/// Does the ray's line pass well inside a triangle of the sheet (Moller & Trumbore 1997)? Not beside it, nor by its
/// rim.
bool passes_through(const Ray& ray, const Sheet& sheet) {
  constexpr double kInside = 1e-3;
  const Vec3 origin = load(ray.origin), direction = load(ray.direction);
  for (std::size_t i = 0; i < sheet.size(); i += 3) {
    const Vec3 a = to_vec3(sheet[i]), e1 = to_vec3(sheet[i + 1]) - a, e2 = to_vec3(sheet[i + 2]) - a;
    const Vec3 p = glm::cross(direction, e2), s = origin - a;
    const double determinant = glm::dot(e1, p);
    const double u = glm::dot(s, p) / determinant, v = glm::dot(direction, glm::cross(s, e1)) / determinant;
    if (u > kInside && v > kInside && u + v < 1 - kInside) return true;
  }
  return false;
}

TEST(ShadowRay, BlockerJustInFrontOfAnEmissiveMeshHidesIt) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937_64 random(kSeed);
  int traced = 0;
  for (int scene = 0; scene < kScenes; ++scene) {
    const Setting setting = random_setting(random);
    const Sheet sheet = random_sheet(random, setting.middle, setting.size, 0);
    Lamp lamp;
    make_lamp(sheet, lamp);
    lamp.file.materials[0].double_sided = false;
    // The lamp again, twice as wide, moved to the front by a few times what rounding does to coordinates.
    const Vec3 a = to_vec3(sheet[0]), b = to_vec3(sheet[1]), c = to_vec3(sheet[2]);
    const Vec3 normal = glm::normalize(glm::cross(b - a, c - a));
    const double gap = 0x1p-20 * (glm::length(setting.middle) + 1000 * setting.size);
    Sheet cover = sheet;
    for (io::Float3& corner : cover) {
      store(to_vec3(corner) + (to_vec3(corner) - a) + gap * normal, corner.data());
    }
    lamp.file.meshes.push_back(mesh_of(cover));
    lamp.file.meshes.back().material = 1;
    place(lamp.file, 1);
    lamp.build();
    for (int i = 0; i < kRays; ++i) {
      const Vec3 origin = random_origin(random, setting);
      const double height = glm::dot(origin - a, normal);
      // Not from beneath the cover.
      if (height < 4 * gap + 0.01 * glm::length(origin - a)) continue;
      const Receiver at = receiver(origin, Vec3(0, 0, 1));
      const Arrival arrival = lamp.light->sample(at, random_point(random));
      ASSERT_EQ(arrival.unreached, Unreached::no);
      const Ray ray = shadow_ray(at, arrival);
      if (!passes_through(ray, cover)) continue;
      ++traced;
      ASSERT_TRUE(lamp.world.scene.occluded(ray)) << "scene " << scene << " ray " << i;
    }
  }
  EXPECT_GT(traced, kScenes * kRays / 4);
}

TEST(ShadowRay, RectangleThatLiesOnACeilingIsNotHiddenByIt) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> uniform(-4, 4);
  for (const double height : {2.7, 1234.56, 3e-5}) {
    // The ceiling's height is the nearest float; the light's is that float too.
    const auto ceiling = static_cast<float>(height);
    io::SceneFile file = scene_of(quad({-9, -9, ceiling}, {-9, 9, ceiling}, {9, 9, ceiling}, {9, -9, ceiling}));
    place(file, 0);
    World world;
    ASSERT_TRUE(build_world(file, {}, world).ok());
    io::Light panel;
    panel.type = io::LightType::rectangle;
    panel.position = {0.3, -0.2, double{ceiling}};
    const auto light = make_light(panel, world);
    for (int i = 0; i < 2000; ++i) {
      const double x = uniform(random), y = uniform(random), depth = std::abs(uniform(random)) * height;
      const Receiver at = receiver(rounded(Vec3(x, y, ceiling - depth)), Vec3(0, 0, 1));
      const Arrival arrival = light->sample(at, random_point(random));
      if (arrival.unreached != Unreached::no) continue;
      ASSERT_FALSE(world.scene.occluded(shadow_ray(at, arrival))) << height << " ray " << i;
    }
  }
}

TEST(ShadowRay, EndsAtThePunctualLightItself) {
  const World nothing;
  const auto light = make_light(point_light({1, 2, 3}, 1), nothing);
  const Receiver at = {Vec3(0, 0, 0), Vec3(0, 0, 0.25), Vec3(0, 0, 1)};
  const Ray ray = shadow_ray(at, light->sample(at, {}));
  EXPECT_EQ(load(ray.origin) + load(ray.direction), Vec3(1, 2, 3));
  EXPECT_EQ(ray.tmax, 1);
}

}  // namespace
}  // namespace umbrix::render
