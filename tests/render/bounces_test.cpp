// SPDX-License-Identifier: Apache-2.0
// Light that goes from surface to surface, against what must come out.
#include <gtest/gtest.h>

#include <cmath>

#include "built_scenes.h"
#include "light_estimates.h"

namespace umbrix::render {
namespace {

RenderOptions small_options(std::uint32_t samples, std::uint32_t bounces) {
  RenderOptions options;
  options.width = options.height = 4;
  options.samples = samples;
  options.bounces = bounces;
  return options;
}

io::Image image_of(const World& world, const View& view, const RenderOptions& options) {
  io::Image image;
  RenderStats stats;
  const Status status = render(world, view, options, image, stats);
  EXPECT_TRUE(status.ok()) << status.message();
  return image;
}

/// Of the whole image, in green, over images of different seeds.
Mean mean_over_seeds(const World& world, const View& view, RenderOptions options) {
  constexpr std::uint64_t kSeeds = 300;
  MeanSum sum;
  for (options.seed = 0; options.seed < kSeeds; ++options.seed) {
    const io::Image image = image_of(world, view, options);
    double green = 0;
    for (std::size_t i = 1; i < image.pixels.size(); i += 4) green += image.pixels[i];
    sum.add(green / (options.width * options.height));
  }
  return sum.mean();
}

io::Light environment(float intensity) {
  io::Light light;
  light.type = io::LightType::environment;
  light.intensity = intensity;
  return light;
}

/// Whatever its shape, a thing that reflects all light looks as the even light all around it.
TEST(Bounces, WhiteMetalVanishesInAFurnace) {
  Clutter made = clutter(3);
  made.view.lights = {environment(2)};
  for (const float roughness : {0.0f, 0.3f, 0.7f, 1.0f}) {
    made.scene.materials[0].metallic = 1;
    made.scene.materials[0].roughness = roughness;
    World world;
    ASSERT_TRUE(build_world(made.scene, {}, world).ok());
    const Mean mean = mean_over_seeds(world, made.view, small_options(4, 100));
    // Each reflection may be wrong by the table of what is reflected at once (ggx.h).
    EXPECT_NEAR(mean.value, 2, 5 * mean.error + 0.02) << roughness << " " << mean.error;
  }
}

/// A metal floor and what shines on it, which reflects nothing: bounces add no light, but find the lights themselves.
struct LitFloor {
  LitFloor() : scene(scene_of(quad({-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}))) {
    place(scene, 0);
    view.camera = camera_from_above(2, 0.8);
  }

  void add_panel(float x, float size) {
    scene.meshes.push_back(
        quad({x - size, -size, 1.5f}, {x - size, size, 1.6f}, {x + size, size, 1.8f}, {x + size, -size, 1.5f}));
    scene.meshes.back().material = 1;
    place(scene, static_cast<std::uint32_t>(scene.meshes.size() - 1));
  }

  void expect_no_change() {
    scene.materials.resize(2);
    scene.materials[1].base_color = {0, 0, 0};
    scene.materials[1].metallic = 1;
    scene.materials[1].emission = {5, 5, 5};
    for (const io::Light& light : io::emissive_lights(scene)) view.lights.push_back(light);
    for (const float roughness : {0.3f, 0.8f}) {
      scene.materials[0].metallic = 0.5f;
      scene.materials[0].roughness = roughness;
      World world;
      ASSERT_TRUE(build_world(scene, {}, world).ok());
      const Mean without = mean_over_seeds(world, view, small_options(4, 0));
      const Mean with = mean_over_seeds(world, view, small_options(4, 1));
      EXPECT_GT(without.value, 0.01);
      EXPECT_NEAR(with.value, without.value, 5 * std::hypot(with.error, without.error)) << roughness;
    }
  }

  io::SceneFile scene;
  View view;
};

TEST(Bounces, FindAMeshLightAsOftenAsShadowRaysDo) {
  LitFloor lit;
  lit.add_panel(1, 0.6f);
  lit.expect_no_change();
}

TEST(Bounces, FindManyMeshLightsAsOftenAsShadowRaysDo) {
  LitFloor lit;
  for (int i = 0; i < 12; ++i) lit.add_panel(static_cast<float>(i) - 5.5f, i == 6 ? 0.4f : 0.2f);
  lit.expect_no_change();
}

TEST(Bounces, FindAnEnvironmentAsOftenAsShadowRaysDo) {
  LitFloor even;
  even.view.lights = {environment(1)};
  even.expect_no_change();
  auto map = std::make_shared<io::EnvironmentMap>();
  map->width = 16;
  map->height = 8;
  map->pixels.assign(16 * 8, {0.1f, 0.1f, 0.1f});
  map->pixels[16 * 4 + 5] = {40, 40, 40};
  LitFloor mapped;
  mapped.scene.instances[0].to_world = {{{1, 0, 0, 0}, {0, 0, 1, 0}, {0, -1, 0, 0}}};  // faces +y, the map's top
  mapped.view.camera.to_world = {{{1, 0, 0, 0}, {0, 0, 1, 2}, {0, -1, 0, 0}}};
  mapped.view.lights = {environment(1)};
  mapped.view.lights[0].environment = map;
  mapped.expect_no_change();
}

/// A floor in the shadow of a sheet, beside a red wall in the light.
TEST(Bounces, AWallInTheLightColoursAFloorInTheShadow) {
  io::SceneFile scene = scene_of(quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}));
  scene.meshes.push_back(quad({-2, -2, 3}, {1.9f, -2, 3}, {1.9f, 2, 3}, {-2, 2, 3}));
  scene.meshes.push_back(quad({2, -2, 0}, {2, -2, 2}, {2, 2, 2}, {2, 2, 0}));
  scene.materials.resize(2);
  scene.materials[1].base_color = {0.8f, 0, 0};
  scene.materials[1].metallic = 0;
  scene.meshes[2].material = 1;
  for (std::uint32_t i = 0; i < 3; ++i) place(scene, i);
  World world;
  ASSERT_TRUE(build_world(scene, {}, world).ok());
  View view;
  view.camera = camera_from_above(2.5, 0.5);
  view.lights = {point_light({1.95, 0, 4}, 60)};
  const io::Image direct = image_of(world, view, small_options(16, 0));
  const io::Image bounced = image_of(world, view, small_options(64, 1));
  double red = 0, green = 0;
  for (std::size_t i = 0; i < direct.pixels.size(); i += 4) {
    EXPECT_EQ(direct.pixels[i], 0);
    red += bounced.pixels[i];
    green += bounced.pixels[i + 1];
  }
  EXPECT_GT(red, 0.01);
  EXPECT_LT(green, 0.3 * red);
}

TEST(Bounces, APreviewShowsTheSamplesSoFarAndChangesNothing) {
  const Clutter made = clutter(4);
  World world;
  ASSERT_TRUE(build_world(made.scene, {}, world).ok());
  RenderOptions options = small_options(7, 2);
  options.width = 70;  // several tiles
  const io::Image plain = image_of(world, made.view, options);
  std::vector<std::uint32_t> shown;
  io::Image first;
  options.preview = [&](const io::Image& image, std::uint32_t samples) {
    if (shown.empty()) first = image;
    shown.push_back(samples);
  };
  EXPECT_EQ(image_of(world, made.view, options).pixels, plain.pixels);
  EXPECT_EQ(shown, (std::vector<std::uint32_t>{1, 2, 4}));
  EXPECT_EQ(first.pixels.size(), plain.pixels.size());
  EXPECT_NE(first.pixels, plain.pixels);
}

}  // namespace
}  // namespace umbrix::render
