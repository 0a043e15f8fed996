// SPDX-License-Identifier: Apache-2.0
// What lights with an area send, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "built_scenes.h"
#include "light_estimates.h"
#include "textured_scenes.h"

namespace umbrix::render {
namespace {

constexpr unsigned kSeed = 20;

/// Lambert 1760: a polygon of radiance 1 above the horizon, seen from the origin by a surface with this normal.
double polygon_irradiance(const std::vector<Vec3>& corners, const Vec3& normal) {
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 a = glm::normalize(corners[i]), b = glm::normalize(corners[(i + 1) % corners.size()]);
    const Vec3 across = glm::cross(a, b);
    sum += std::atan2(glm::length(across), glm::dot(a, b)) * glm::dot(glm::normalize(across), normal);
  }
  return std::abs(sum) / 2;
}

io::Double3 numbers(const Vec3& v) { return {v.x, v.y, v.z}; }

io::Light rectangle(const Vec3& centre, const Vec3& half_u, const Vec3& half_v) {
  io::Light light;
  light.type = io::LightType::rectangle;
  light.position = numbers(centre);
  light.direction = numbers(glm::normalize(glm::cross(half_u, half_v)));
  light.half_edges = {numbers(half_u), numbers(half_v)};
  return light;
}

TEST(AreaLights, RectangleOverheadHasItsFormFactor) {
  // A unit square that looks straight down from height 1 on the point below a corner: Howell's catalogue, B-3.
  const World nothing;
  const auto light = make_light(rectangle({0.5, 0.5, 1}, {0, 0.5, 0}, {0.5, 0, 0}), nothing);
  std::mt19937_64 random(kSeed);
  const double half = 1 / std::sqrt(2.0);
  const double form_factor = 2 * half * std::atan(half) / (2 * kPi);
  expect_mean(irradiance(*light, receiver(Vec3(0), Vec3(0, 0, 1)), random), kPi * form_factor);
}

/// Random rectangles whose facing side the origin sees, with corners above its horizon.
void for_random_rectangles(std::mt19937_64& random, double size, double distance,
                           const std::function<void(const io::Light&, const std::vector<Vec3>&, const Vec3&)>& check) {
  for (int made = 0; made < 12;) {
    const Vec3 normal = unit_vector(random), u = unit_vector(random);
    const Vec3 half_u = size * u;
    const Vec3 half_v = 0.4 * size * glm::normalize(glm::cross(u, unit_vector(random)));
    const Vec3 centre = distance * unit_vector(random);
    const std::vector<Vec3> corners = {centre - half_u - half_v, centre + half_u - half_v, centre + half_u + half_v,
                                       centre - half_u + half_v};
    bool above = glm::dot(glm::cross(half_u, half_v), centre) < 0;
    for (const Vec3& corner : corners) above = above && glm::dot(corner, normal) > 0;
    if (!above) continue;
    ++made;
    check(rectangle(centre, half_u, half_v), corners, normal);
  }
}

TEST(AreaLights, RectanglesOfAllSizesShineAsPolygonsDo) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937_64 random(kSeed);
  const World nothing;
  for (const double size : {1e-4, 0.01, 0.3, 1.0, 30.0}) {
    for_random_rectangles(random, size, 1, [&](const io::Light& light, const auto& corners, const Vec3& normal) {
      SCOPED_TRACE(size);
      expect_mean(irradiance(*make_light(light, nothing), receiver(Vec3(0), normal), random),
                  polygon_irradiance(corners, normal));
    });
  }
}

TEST(AreaLights, RectangleShinesOnOneSide) {
  const World nothing;
  const auto light = make_light(rectangle({0, 0, 1}, {0.5, 0, 0}, {0, 0.5, 0}), nothing);  // looks up
  for (const double height : {0.0, 0.5, 1.0}) {
    EXPECT_EQ(light->sample(receiver(Vec3(0, 0, height), Vec3(0, 0, 1)), {0.3, 0.4}).unreached,
              Unreached::emitter_faces_away);
  }
  EXPECT_EQ(light->sample(receiver(Vec3(0, 0, 1.5), Vec3(0, 0, -1)), {0.3, 0.4}).unreached, Unreached::no);
}

TEST(AreaLights, SphereShinesAsADiscOfItsAngle) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937_64 random(kSeed);
  const World nothing;
  for (const double radius : {1e-4, 0.05, 0.5, 0.99}) {
    for (const double tilt : {0.0, 0.1, 0.9}) {
      if (std::sin(kPi / 2 - tilt) < radius) continue;  // dips below the horizon
      SCOPED_TRACE(radius);
      io::Light light;
      light.type = io::LightType::sphere;
      light.radius = static_cast<float>(radius);
      light.position = {1, 2, 4};
      light.intensity = 3;
      const Receiver at = receiver(Vec3(1, 2, 3), Vec3(std::sin(tilt), 0, std::cos(tilt)));
      const double r = light.radius;
      expect_mean(irradiance(*make_light(light, nothing), at, random), 3 * kPi * r * r * std::cos(tilt));
    }
  }
}

TEST(AreaLights, SphereDoesNotShineWithinItself) {
  const World nothing;
  io::Light light;
  light.type = io::LightType::sphere;
  light.radius = 1;
  const auto sphere = make_light(light, nothing);
  EXPECT_EQ(sphere->sample(receiver(Vec3(0.5, 0, 0), Vec3(1, 0, 0)), {0.5, 0.5}).unreached,
            Unreached::emitter_faces_away);
}

/// One triangle as an emissive mesh.
struct Lamp {
  io::SceneFile file;
  World world;

  explicit Lamp(const std::vector<io::Float3>& corners, bool double_sided = false) {
    io::Mesh mesh;
    mesh.positions = corners;
    mesh.triangles = {{0, 1, 2}};
    file = scene_of(mesh);
    file.materials[0].emission = {1, 1, 1};
    file.materials[0].double_sided = double_sided;
    place(file, 0);
    EXPECT_TRUE(build_world(file, {}, world).ok());
  }

  std::unique_ptr<Light> light() const { return make_light(io::emissive_lights(file).at(0), world); }
};

TEST(AreaLights, TrianglesOfAllSizesShineAsPolygonsDo) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<float> uniform(-1, 1);
  for (const float size : {1e-3f, 0.1f, 1.0f, 50.0f}) {
    for (int made = 0; made < 12;) {
      const Vec3 normal = unit_vector(random), centre = unit_vector(random);
      io::Mesh mesh;
      std::vector<Vec3> corners;
      bool above = true;
      for (int k = 0; k < 3; ++k) {
        io::Float3 corner;
        for (int axis = 0; axis < 3; ++axis) {
          corner[static_cast<std::size_t>(axis)] = static_cast<float>(centre[axis]) + size * uniform(random);
        }
        mesh.positions.push_back(corner);
        corners.push_back(to_vec3(corner));
        above = above && glm::dot(corners.back(), normal) > 0;
      }
      const double facing = -glm::dot(glm::cross(corners[1] - corners[0], corners[2] - corners[0]), corners[0]);
      if (!above || !(facing > 0)) continue;
      ++made;
      SCOPED_TRACE(size);
      expect_mean(irradiance(*Lamp(mesh.positions).light(), receiver(Vec3(0), normal), random),
                  polygon_irradiance(corners, normal));
    }
  }
}

// As the part of it that the image lights, and by the image's colour.
TEST(AreaLights, TexturedTriangleShinesWhereItsImageDoes) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937_64 random(kSeed);
  Lamp lamp({{-1, -1, 1}, {-1, 2, 1}, {2, -1, 1}});
  lamp.file.meshes[0].texcoord_sets[0] = {{0, 0}, {0, 0}, {1, 0}};
  lamp.file.materials[0].emission = {4, 4, 4};
  io::TextureUse& use = lamp.file.materials[0].emissive_texture;
  use.texture = add_texture(lamp.file, 2, 1, {0, 0, 0, 0, 255, 0}, {Wrap::repeat, Wrap::repeat, true});
  const Vec3 normal(0, 0, 1);
  const double whole = polygon_irradiance({{-1, -1, 1}, {-1, 2, 1}, {2, -1, 1}}, normal);
  const double lit = polygon_irradiance({{0.5, -1, 1}, {0.5, 0.5, 1}, {2, -1, 1}}, normal);
  expect_mean(irradiance(*lamp.light(), receiver(Vec3(0), normal), random), 4 * lit);
  use.transform[0][2] = 0.5;  // the other part
  expect_mean(irradiance(*lamp.light(), receiver(Vec3(0), normal), random), 4 * (whole - lit));
}

TEST(AreaLights, TriangleShinesBehindOnlyIfDoubleSided) {
  const std::vector<io::Float3> corners = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}};  // its front is above
  const Receiver below = receiver(Vec3(0.2, 0.2, 0), Vec3(0, 0, 1));
  const Receiver above = receiver(Vec3(0.2, 0.2, 2), Vec3(0, 0, -1));
  EXPECT_EQ(Lamp(corners).light()->sample(below, {0.5, 0.5}).unreached, Unreached::emitter_faces_away);
  const Arrival front = Lamp(corners).light()->sample(above, {0.5, 0.5});
  EXPECT_EQ(front.normal, Vec3(0, 0, 1));
  const Arrival back = Lamp(corners, true).light()->sample(below, {0.5, 0.5});
  EXPECT_EQ(back.unreached, Unreached::no);
  EXPECT_EQ(back.normal, Vec3(0, 0, -1));
  EXPECT_NEAR(back.irradiance.r, front.irradiance.r, 1e-12);
}

TEST(AreaLights, MirroredInstanceKeepsItsFront) {
  Lamp lamp({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}});
  lamp.file.instances[0].to_world[0][0] = -1;
  ASSERT_TRUE(build_world(lamp.file, {}, lamp.world).ok());
  const Arrival above = lamp.light()->sample(receiver(Vec3(-0.2, 0.2, 2), Vec3(0, 0, -1)), {0.5, 0.5});
  EXPECT_EQ(above.unreached, Unreached::no);
  EXPECT_EQ(above.normal, Vec3(0, 0, 1));
}

}  // namespace
}  // namespace umbrix::render
