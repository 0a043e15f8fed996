// SPDX-License-Identifier: Apache-2.0
// Whole renders of scenes whose light is known in closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "built_scenes.h"
#include "render/vec.h"

namespace umbrix::render {
namespace {

struct Rendered {
  io::Image image;
  RenderStats stats;

  float at(int x, int y, std::size_t channel) const {
    return image.pixels[static_cast<std::size_t>(y * image.width + x) * image.channels.size() + channel];
  }
};

Rendered rendered(const io::SceneFile& scene, const View& view, const RenderOptions& options) {
  World world;
  Status status = build_world(scene, {}, world);
  EXPECT_TRUE(status.ok()) << status.message();
  Rendered result;
  status = render(world, view, options, result.image, result.stats);
  EXPECT_TRUE(status.ok()) << status.message();
  return result;
}

RenderOptions square(int size) {
  RenderOptions options;
  options.width = options.height = size;
  return options;
}

/// Sees [-2, 2] x [-2, 2] from `height`; a pixel's centre is at pixel_x, -pixel_x.
io::Camera map_camera(double height) {
  io::Camera camera = camera_from_above(height, 1);
  camera.type = io::CameraType::orthographic;
  camera.ymag = 2;
  return camera;
}

double pixel_x(int x, int size) { return 4 * (x + 0.5) / size - 2; }

io::SceneFile floor_scene() {
  io::SceneFile scene = scene_of(quad({-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}));
  place(scene, 0);
  return scene;
}

TEST(DirectLight, WhiteFloorUnderAPointLightHasTheAnalyticRadiance) {
  const Rendered r = rendered(floor_scene(), {map_camera(5), {point_light({0.5, 0, 2}, 5)}}, square(16));
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      const double dx = 0.5 - pixel_x(x, 16), dy = pixel_x(y, 16), d2 = dx * dx + dy * dy + 4;
      const double cosine = 2 / std::sqrt(d2);
      // glTF's material of roughness 1, seen straight on: D = 1/pi, V = 1 / (2 (1 + cosine)).
      const double fresnel = 0.04 + 0.96 * std::pow(1 - std::sqrt((1 + cosine) / 2), 5);
      const double bsdf = (1 - fresnel) / kPi + fresnel / kPi * 0.5 / (1 + cosine);
      const double expected = bsdf * 5 / d2 * cosine;
      EXPECT_NEAR(r.at(x, y, 0), expected, 1e-6 * expected);
      EXPECT_EQ(r.at(x, y, 3), 1);
    }
  }
}

TEST(DirectLight, LightsAddUp) {
  const io::Light a = point_light({0.5, 0, 2}, 5), b = point_light({-1, 1, 1}, 2);
  const Rendered both = rendered(floor_scene(), {map_camera(5), {a, b}}, square(8));
  const Rendered first = rendered(floor_scene(), {map_camera(5), {a}}, square(8));
  const Rendered second = rendered(floor_scene(), {map_camera(5), {b}}, square(8));
  for (int i = 0; i < 64; ++i) {
    const float sum = first.at(i % 8, i / 8, 0) + second.at(i % 8, i / 8, 0);
    EXPECT_NEAR(both.at(i % 8, i / 8, 0), sum, 1e-6f * sum);
  }
}

TEST(DirectLight, ShadowEdgeIsWhereGeometrySays) {
  // The edge x = 0 at height 1, seen from the light at (-1, 0, 2), falls on the floor at x = 1.
  io::SceneFile scene = floor_scene();
  scene.meshes.push_back(quad({0, -9, 1}, {9, -9, 1}, {9, 9, 1}, {0, 9, 1}));
  place(scene, 1);
  const Rendered r = rendered(scene, {map_camera(0.5), {point_light({-1, 0, 2}, 5)}}, square(64));
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) EXPECT_EQ(r.at(x, y, 0) > 0, pixel_x(x, 64) < 1) << x << " " << y;
  }
}

TEST(DirectLight, EmissionShowsWithoutLights) {
  io::SceneFile scene = floor_scene();
  scene.materials[0].emission = {1, 2, 3};
  const Rendered r = rendered(scene, {map_camera(5), {}}, square(2));
  for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(r.at(1, 1, c), static_cast<float>(c + 1));
}

TEST(DirectLight, NothingSeenIsBlackAndTransparent) {
  RenderOptions options = square(4);
  options.aovs = {"normal", "depth", "albedo", "shadow"};
  const Rendered r = rendered(io::SceneFile(), {map_camera(5), {point_light({0, 0, 2}, 5)}}, options);
  for (std::size_t c = 0; c < r.image.channels.size(); ++c) {
    const bool depth = r.image.channels[c] == "depth.Z";
    EXPECT_EQ(r.at(1, 1, c), depth ? std::numeric_limits<float>::infinity() : 0) << r.image.channels[c];
  }
}

TEST(DirectLight, LightsThatCannotReachCostNoRay) {
  io::Light below = point_light({0, 0, -1}, 5), short_range = point_light({0, 0, 2}, 5), off = short_range;
  short_range.range = 1;
  off.intensity = 0;
  io::Light narrow = point_light({50, 0, 2}, 5);
  narrow.type = io::LightType::spot;
  narrow.outer_cone_angle = 0.1f;
  const Rendered r = rendered(floor_scene(), {map_camera(5), {below, short_range, off, narrow}}, square(4));
  EXPECT_EQ(r.stats.shadow().rays(), 0u);
  EXPECT_EQ(r.stats.lights[0].skipped_behind, 16u);
  EXPECT_EQ(r.stats.lights[1].skipped_range, 16u);
  EXPECT_EQ(r.stats.lights[2].skipped_no_power, 16u);
  EXPECT_EQ(r.stats.lights[3].skipped_cone, 16u);
}

/// A sphere of flat triangles, rings x 2 rings.
io::Mesh sphere(std::uint32_t rings, float radius, const io::Float3& centre) {
  io::Mesh mesh;
  const std::uint32_t sectors = 2 * rings;
  for (std::uint32_t ring = 0; ring <= rings; ++ring) {
    for (std::uint32_t sector = 0; sector < sectors; ++sector) {
      const double theta = kPi * ring / rings, phi = 2 * kPi * sector / sectors;
      mesh.positions.push_back({static_cast<float>(centre[0] + radius * std::sin(theta) * std::cos(phi)),
                                static_cast<float>(centre[1] + radius * std::sin(theta) * std::sin(phi)),
                                static_cast<float>(centre[2] + radius * std::cos(theta))});
      const std::uint32_t next = (sector + 1) % sectors, row = ring * sectors;
      if (ring == rings) continue;
      mesh.triangles.push_back({row + sector, row + sectors + sector, row + sectors + next});
      mesh.triangles.push_back({row + sector, row + sectors + next, row + next});
    }
  }
  return mesh;
}

TEST(DirectLight, SphereDoesNotShadowItsLitSideAtAnyScale) {
  for (const float radius : {1e-6f, 1.0f, 1e6f}) {
    SCOPED_TRACE(radius);
    io::SceneFile scene = scene_of(sphere(40, radius, {0, 0, 0}));
    place(scene, 0);
    io::Camera camera = map_camera(10.0 * radius);
    camera.ymag = radius;
    io::Light light;
    light.type = io::LightType::directional;
    light.direction = {0.6, 0, -0.8};
    const Rendered r = rendered(scene, {camera, {light}}, square(128));
    EXPECT_GT(r.stats.lights[0].unoccluded, 8000u);
    EXPECT_EQ(r.stats.lights[0].occluded, 0u);
  }
}

TEST(DirectLight, ClosedSphereLetsNoLightIn) {
  // Far from the origin, where coordinates are coarse; the camera is inside, the light outside.
  const io::Float3 centre = {1484, 12, -2232};
  io::SceneFile scene = scene_of(sphere(50, 2, centre));
  place(scene, 0);
  io::Camera camera;
  camera.yfov = 2.5;
  for (std::size_t axis = 0; axis < 3; ++axis) camera.to_world[axis][3] = centre[axis];
  const Rendered r = rendered(scene, {camera, {point_light({1490, 13, -2230}, 1e4)}}, square(128));
  EXPECT_EQ(r.stats.camera_hits, 128u * 128u);
  EXPECT_EQ(r.stats.lights[0].unoccluded, 0u);
  EXPECT_EQ(*std::max_element(r.image.pixels.begin(), r.image.pixels.end()), 1) << "alpha alone";
}

TEST(DirectLight, ChannelsHoldWhatTheirNamesSay) {
  io::SceneFile scene = floor_scene();
  scene.materials[0].base_color = {0.5f, 0.25f, 0.125f};
  scene.meshes.push_back(quad({0, -9, 1}, {9, -9, 1}, {9, 9, 1}, {0, 9, 1}));
  place(scene, 1);
  RenderOptions options = square(8);
  options.aovs = {"shadow", "depth", "normal", "albedo", "node_tests", "primitive_tests", "kernel"};
  options.samples = 4;
  const View view = {map_camera(0.5), {point_light({-1, 0, 2}, 5), point_light({-1, 0, 0.25}, 5)}};
  const Rendered r = rendered(scene, view, options);
  const std::vector<std::string> expected = {"R",
                                             "G",
                                             "B",
                                             "A",
                                             "shadow.Y",
                                             "depth.Z",
                                             "normal.X",
                                             "normal.Y",
                                             "normal.Z",
                                             "albedo.R",
                                             "albedo.G",
                                             "albedo.B",
                                             "node_tests.Y",
                                             "primitive_tests.Y",
                                             "kernel.cached",
                                             "kernel.beam",
                                             "kernel.indexed",
                                             "kernel.linked",
                                             "kernel.other"};
  EXPECT_EQ(r.image.channels, expected);
  EXPECT_EQ(r.at(0, 4, 4), 1) << "both lights reach";
  EXPECT_EQ(r.at(7, 4, 4), 0.5) << "only the one below the blocker reaches";
  EXPECT_EQ(r.at(0, 4, 5), 0.5) << "depth";
  EXPECT_EQ(r.at(0, 4, 8), 1) << "normal.Z";
  EXPECT_EQ(r.at(0, 4, 10), 0.25) << "albedo.G";
  EXPECT_GT(r.at(0, 4, 12), 0) << "node_tests";
  EXPECT_GT(r.at(7, 4, 13), 0) << "primitive_tests";
  EXPECT_EQ(r.at(7, 4, 14) + r.at(7, 4, 15) + r.at(7, 4, 16) + r.at(7, 4, 17) + r.at(7, 4, 18), 1)
      << "shares of the ways";
  for (const LightStats& light : r.stats.lights) {
    EXPECT_EQ(std::accumulate(light.routes.begin(), light.routes.end(), std::uint64_t{0}), light.rays());
  }
}

}  // namespace
}  // namespace umbrix::render
