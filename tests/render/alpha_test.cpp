// SPDX-License-Identifier: Apache-2.0
// Alpha in camera and shadow rays: cut out by masks, by chance where it blends; the same with every kernel.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "render/vec.h"
#include "textured_scenes.h"

namespace umbrix::render {
namespace {

/// Sees [-2, 2] x [-2, 2] from above.
io::Camera map_camera() {
  io::Camera camera = camera_from_above(5, 1);
  camera.type = io::CameraType::orthographic;
  camera.ymag = 2;
  return camera;
}

/// A card of the material 0 at `height` over a floor of material 1, from -1 to 1.
io::SceneFile card_over_floor(double height) {
  io::SceneFile scene = card_scene();
  scene.materials.resize(2);
  scene.materials[1].metallic = 0;
  scene.meshes.push_back(quad({-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}));
  scene.meshes[1].material = 1;
  place(scene, 0, {{{2, 0, 0, -1}, {0, 2, 0, -1}, {0, 0, 1, height}}});
  place(scene, 1);
  return scene;
}

io::Light sun() {
  io::Light light;
  light.type = io::LightType::directional;
  light.intensity = static_cast<float>(kPi);
  return light;
}

io::Image picture(const World& world, const View& view, RenderOptions options) {
  io::Image image;
  RenderStats stats;
  const Status status = render(world, view, options, image, stats);
  EXPECT_TRUE(status.ok()) << status.message();
  return image;
}

RenderOptions options_of(int size) {
  RenderOptions options;
  options.width = options.height = size;
  return options;
}

double red(const io::Image& image, int x, int y) {
  return image.pixels[static_cast<std::size_t>(y * image.width + x) * image.channels.size()];
}

/// The upper left and lower right quarters are opaque.
void mask_with_quarters(io::SceneFile& scene) {
  scene.materials[0].alpha_mode = io::AlphaMode::mask;
  scene.materials[0].base_color_texture.texture = add_texture(
      scene, 2, 2, {255, 0, 0, 255, 9, 9, 9, 0, 9, 9, 9, 0, 255, 0, 0, 255}, {Wrap::clamp, Wrap::clamp, true});
}

TEST(Alpha, MasksCutOutOfCameraAndShadowRays) {
  io::SceneFile scene = card_over_floor(1);
  mask_with_quarters(scene);
  World world;
  ASSERT_TRUE(build_world(scene, {}, world).ok());
  // The sun moves the shadow by 0.5 to the right.
  io::Light light = sun();
  light.direction = {0.5 / std::sqrt(1.25), 0, -1 / std::sqrt(1.25)};
  const io::Image image = picture(world, {map_camera(), {light}}, options_of(16));
  const double floor = red(image, 0, 0);
  ASSERT_GT(floor, 0.1);
  for (int y = 4; y < 12; ++y) {
    for (int x = 4; x < 14; ++x) {
      const bool top = y < 8;
      const bool card = x < 12 && (top ? x < 8 : x >= 8);
      const bool shadow = x >= 6 && (top ? x < 10 : x >= 10);
      if (card) {
        EXPECT_NEAR(image.pixels[static_cast<std::size_t>(y * 16 + x) * 4 + 1], 0.04 / 4, 0.01) << x << ' ' << y;
      } else {
        EXPECT_NEAR(red(image, x, y), shadow ? 0 : floor, 1e-3 * floor) << x << ' ' << y;
      }
    }
  }
}

TEST(Alpha, SolidMeshesAskNothing) {
  io::SceneFile scene = card_over_floor(1);
  scene.materials[0].alpha_mode = io::AlphaMode::mask;
  scene.materials[0].base_color_texture.texture = add_texture(scene, 1, 1, {9, 9, 9, 200});
  World world;
  ASSERT_TRUE(build_world(scene, {}, world).ok());
  ASSERT_EQ(world.alpha.size(), 1u);
  EXPECT_EQ(world.alpha[0].test().opaque, nullptr) << "200 of 255 is above the cut-off everywhere";
  scene.images[0].channels = 3;
  scene.images[0].pixels.resize(3);
  ASSERT_TRUE(build_world(scene, {}, world).ok());
  EXPECT_TRUE(world.alpha.empty());
}

TEST(Alpha, BlendedSheetsLetTheirShareOfLightThrough) {
  const double alpha = 0.3;
  io::SceneFile scene = card_over_floor(1);
  scene.materials[0].alpha_mode = io::AlphaMode::blend;
  scene.materials[0].alpha = static_cast<float>(alpha);
  scene.materials[0].unlit = true;
  scene.materials[0].base_color = {0, 0, 0};
  World world;
  ASSERT_TRUE(build_world(scene, {}, world).ok());
  // Away from the edges: black where the card is seen, else the floor in the sun or in the card's shadow, so that a
  // floor of radiance L is seen with (1 - alpha)^2 L.
  for (const std::uint32_t samples : {1u, 16u}) {
    RenderOptions options = options_of(64);
    options.samples = samples;
    io::Light light = sun();
    light.direction = {0.1 / std::sqrt(1.01), 0, -1 / std::sqrt(1.01)};
    const io::Image image = picture(world, {map_camera(), {light}}, options);
    const double floor = red(image, 2, 2);
    double sum = 0;
    int count = 0;
    for (int y = 20; y < 44; ++y) {
      for (int x = 20; x < 44; ++x, ++count) sum += red(image, x, y) / floor;
    }
    const double expected = (1 - alpha) * (1 - alpha);
    const double deviation = std::sqrt(expected * (1 - expected) / count / samples);
    EXPECT_NEAR(sum / count, expected, 5 * deviation) << samples;
  }
}

TEST(Alpha, BlendingIsTheSameInEveryRender) {
  io::SceneFile scene = card_over_floor(1);
  scene.materials[0].alpha_mode = io::AlphaMode::blend;
  scene.materials[0].alpha = 0.5f;
  std::vector<io::Image> images;
  for (int i = 0; i < 2; ++i) {
    World world;
    ASSERT_TRUE(build_world(scene, {}, world).ok());
    EXPECT_EQ(world.notes.size(), 1u);
    images.push_back(picture(world, {map_camera(), {sun()}}, options_of(32)));
  }
  EXPECT_EQ(images[0].pixels, images[1].pixels);
}

/// Leaves of all kinds: cards at random with masks and blends, over a floor, under several lights.
io::SceneFile leaves(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(-1, 1);
  io::SceneFile scene = card_over_floor(1.5);
  mask_with_quarters(scene);
  scene.textures[0].sampler.nearest = false;
  scene.materials.resize(3);
  scene.materials[2].alpha_mode = io::AlphaMode::blend;
  scene.materials[2].alpha = 0.5f;
  scene.materials[2].base_color_texture = scene.materials[0].base_color_texture;
  for (std::uint32_t i = 0; i < 120; ++i) {
    io::Mesh card = card_scene().meshes[0];
    for (io::Float3& p : card.positions) p = {0.4f * p[0] + 0.2f * unit(random), 0.4f * p[1], 0.2f * unit(random)};
    card.material = i % 3 == 0 ? 2 : i % 3 == 1 ? 0 : 1;
    scene.meshes.push_back(card);
    const double turn = 3 * static_cast<double>(unit(random)), c = std::cos(turn), s = std::sin(turn);
    place(scene, i + 2,
          {{{c, -s, 0, 1.5 * static_cast<double>(unit(random))},
            {s, c, 0, 1.5 * static_cast<double>(unit(random))},
            {0, 0, 1, 0.8 + 0.6 * static_cast<double>(unit(random))}}});
  }
  return scene;
}

TEST(Alpha, EveryKernelAndInstructionSetGivesTheSamePicture) {
  const std::uint32_t seed = 7;
  SCOPED_TRACE(seed);
  const io::SceneFile scene = leaves(seed);
  io::Light lamp = point_light({0.3, 0.2, 4}, 20), ball = point_light({-1, 1, 3}, 10);
  ball.type = io::LightType::sphere;
  ball.radius = 0.3f;
  const View view = {map_camera(), {lamp, sun(), ball}};
  World world;
  ASSERT_TRUE(build_world(scene, {}, world).ok());
  RenderOptions options = options_of(48);
  options.samples = 2;
  options.light_samples = 4;
  options.aovs = {"shadow", "depth"};
  io::Image expected;
  for (std::size_t target = 0; target < simd_target_count(); ++target) {
    ASSERT_TRUE(use_simd_target(simd_target_name(target)).ok());
    for (std::size_t kernel = 0; kernel < kernel_count(); ++kernel) {
      options.kernel.index = static_cast<int>(kernel);
      ASSERT_TRUE(world.scene.prepare(options.kernel).ok());
      const io::Image image = picture(world, view, options);
      if (expected.pixels.empty()) expected = image;
      EXPECT_EQ(image.pixels, expected.pixels) << kernel_info(kernel).name << ' ' << simd_target_name(target);
    }
  }
  ASSERT_TRUE(use_simd_target(nullptr).ok());
  FrameTracer tracer;
  ASSERT_TRUE(tracer.start(world.scene).ok());
  options.tracer = &tracer;
  for (options.frame = 0; options.frame < 2; ++options.frame) {
    EXPECT_EQ(picture(world, view, options).pixels, expected.pixels) << "frame " << options.frame;
  }
}

}  // namespace
}  // namespace umbrix::render
