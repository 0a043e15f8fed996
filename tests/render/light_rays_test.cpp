// SPDX-License-Identifier: Apache-2.0
// Whole renders with lights that have an area. All pixels see the same point, so each is an independent estimate of one
// number, which is known by quadrature.
#include <gtest/gtest.h>

#include <cmath>

#include "built_scenes.h"
#include "light_estimates.h"
#include "render/bsdf.h"

namespace umbrix::render {
namespace {

io::SceneFile floor_scene() {
  io::SceneFile scene = scene_of(quad({-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}));
  place(scene, 0);
  return scene;
}

/// Looks down at (0, 0, 0), at nearly a point.
io::Camera point_camera() {
  io::Camera camera = camera_from_above(5, 1);
  camera.type = io::CameraType::orthographic;
  camera.ymag = 1e-6;
  return camera;
}

/// 1 x 1, overhead, `x` beside the origin, shining down.
io::Light panel(double x, double height, float radiance) {
  io::Light light;
  light.type = io::LightType::rectangle;
  light.position = {x, 0, height};
  light.direction = {0, 0, -1};
  light.half_edges = {{{0.5, 0, 0}, {0, 0.5, 0}}};
  light.intensity = radiance;
  return light;
}

/// Of a material without textures.
BsdfParameters plain_bsdf(const io::Material& m) { return {to_vec3(m.base_color), m.metallic, m.roughness}; }

/// What the floor sends up at (0, 0, 0) of the panel's light, without anything in between.
double panel_radiance(const io::Light& light) {
  const io::SceneFile scene = floor_scene();
  constexpr int kSteps = 400;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const Vec3 way = to_vec3(light.position) + Vec3((i + 0.5) / kSteps - 0.5, (j + 0.5) / kSteps - 0.5, 0);
      const double d2 = glm::dot(way, way), cosine = way.z / std::sqrt(d2);
      const Rgb bsdf = evaluate_bsdf(plain_bsdf(scene.materials[0]), Vec3(0, 0, 1), Vec3(0, 0, 1), way / std::sqrt(d2));
      sum += bsdf.g * cosine * cosine / d2;
    }
  }
  return sum * light.intensity / (kSteps * kSteps);
}

struct Estimates {
  Mean mean;
  double deviation = 0;  ///< root mean square of a pixel's distance from the truth
  RenderStats stats;
};

Estimates estimate(const io::SceneFile& scene, const std::vector<io::Light>& lights, const RenderOptions& options,
                   double truth) {
  World world;
  EXPECT_TRUE(build_world(scene, {}, world).ok());
  io::Image image;
  Estimates result;
  const Status status = render(world, {point_camera(), lights}, options, image, result.stats);
  EXPECT_TRUE(status.ok()) << status.message();
  MeanSum sum;
  double squares = 0;
  const std::size_t channels = image.channels.size();
  for (std::size_t i = 1; i < image.pixels.size(); i += channels) {
    sum.add(image.pixels[i]);
    squares += (image.pixels[i] - truth) * (image.pixels[i] - truth);
  }
  result.mean = sum.mean();
  result.deviation = std::sqrt(squares * static_cast<double>(channels) / static_cast<double>(image.pixels.size()));
  return result;
}

RenderOptions options(int size, std::uint32_t samples, std::uint32_t light_samples) {
  RenderOptions options;
  options.width = options.height = size;
  options.samples = samples;
  options.light_samples = light_samples;
  return options;
}

TEST(LightRays, ImageOfARectangleIsItsIntegral) {
  const io::Light light = panel(0.4, 1, 2);
  const double truth = panel_radiance(light);
  for (const auto& [samples, light_samples] : {std::pair{1u, 1u}, {1u, 7u}, {5u, 1u}, {3u, 4u}}) {
    SCOPED_TRACE(std::to_string(samples) + " " + std::to_string(light_samples));
    const Estimates e = estimate(floor_scene(), {light}, options(64, samples, light_samples), truth);
    expect_mean(e.mean, truth);
    EXPECT_EQ(e.stats.lights[0].rays() + e.stats.lights[0].skipped(), 64u * 64 * samples * light_samples);
  }
}

TEST(LightRays, BlockerTakesAwayItsShare) {
  // A strip at half the height hides the half of the panel that is at x > 0.
  io::SceneFile scene = floor_scene();
  scene.meshes.push_back(quad({0, -1, 0.5f}, {1, -1, 0.5f}, {1, 1, 0.5f}, {0, 1, 0.5f}));
  place(scene, 1);
  io::Light half = panel(-0.25, 1, 2);
  half.half_edges[0] = {0.25, 0, 0};
  constexpr int kSteps = 400;
  double truth = 0;
  for (int i = 0; i < kSteps; ++i) {
    io::Light strip = half;
    strip.position[0] = -0.5 * (i + 0.5) / kSteps;
    const Vec3 way(strip.position[0], 0, 1);
    for (int j = 0; j < kSteps; ++j) {
      const Vec3 to = way + Vec3(0, (j + 0.5) / kSteps - 0.5, 0);
      const double d2 = glm::dot(to, to), cosine = to.z / std::sqrt(d2);
      const Rgb bsdf = evaluate_bsdf(plain_bsdf(scene.materials[0]), Vec3(0, 0, 1), Vec3(0, 0, 1), to / std::sqrt(d2));
      truth += bsdf.g * cosine * cosine / d2;
    }
  }
  truth *= 2 * 0.5 / (kSteps * kSteps);
  // The camera is below the strip.
  World world;
  ASSERT_TRUE(build_world(scene, {}, world).ok());
  View view = {point_camera(), {panel(0, 1, 2)}};
  view.camera.to_world[2][3] = 0.25;
  io::Image image;
  RenderStats stats;
  ASSERT_TRUE(render(world, view, options(64, 2, 2), image, stats).ok());
  MeanSum sum;
  for (std::size_t i = 1; i < image.pixels.size(); i += 4) sum.add(image.pixels[i]);
  expect_mean(sum.mean(), truth);
  EXPECT_NEAR(static_cast<double>(stats.lights[0].occluded), 0.5 * static_cast<double>(stats.lights[0].rays()), 200);
}

TEST(LightRays, ErrorFallsFasterThanTheRootOfTheRays) {
  const io::Light light = panel(0.4, 1, 2);
  const double truth = panel_radiance(light);
  const double few = estimate(floor_scene(), {light}, options(24, 1, 4), truth).deviation;
  const double many = estimate(floor_scene(), {light}, options(24, 1, 64), truth).deviation;
  const double many_by_pixel = estimate(floor_scene(), {light}, options(24, 64, 1), truth).deviation;
  // 16 times the rays: independent samples would gain 4; strata of a smooth function up to 16.
  EXPECT_GT(few / many, 8);
  EXPECT_GT(few / many_by_pixel, 8);
}

TEST(LightRays, ManyUnequalLightsAddUpToTheSumOfEach) {
  // More than are asked one by one; powers over nine decades; a weak one is near, a black one among them.
  std::vector<io::Light> lights;
  double truth = 0;
  for (int i = 0; i < 12; ++i) {
    lights.push_back(panel(0.3 * i - 1.5, 2 + 0.3 * i, std::pow(10.0f, static_cast<float>(i) - 6)));
  }
  lights.push_back(panel(0, 0.5, 1e-3f));
  lights.push_back(panel(0, 1, 0));
  ASSERT_GT(lights.size(), kMostSampledLights);
  for (const io::Light& light : lights) truth += panel_radiance(light);
  for (const auto& [samples, light_samples] : {std::pair{1u, 1u}, {2u, 3u}}) {
    const Estimates e = estimate(floor_scene(), lights, options(64, samples, light_samples), truth);
    expect_mean(e.mean, truth);
    EXPECT_EQ(e.stats.shadow().rays() + e.stats.shadow().skipped(),
              64u * 64 * samples * light_samples * kMostSampledLights);
    EXPECT_EQ(e.stats.lights.back().rays() + e.stats.lights.back().skipped(), 0u) << "black";
    for (std::size_t i = 0; i + 1 < lights.size(); ++i) EXPECT_GT(e.stats.lights[i].rays(), 0u);
  }
}

TEST(LightRays, EmissiveQuadShinesAsARectangleDoes) {
  io::SceneFile scene = floor_scene();
  scene.materials.resize(2);
  scene.materials[1].emission = {2, 2, 2};
  // Seen from below its corners run counter-clockwise. The camera is below.
  scene.meshes.push_back(quad({-0.1f, -0.5f, 1}, {-0.1f, 0.5f, 1}, {0.9f, 0.5f, 1}, {0.9f, -0.5f, 1}));
  scene.meshes[1].material = 1;
  place(scene, 1);
  World world;
  ASSERT_TRUE(build_world(scene, {}, world).ok());
  View view = {point_camera(), io::emissive_lights(scene)};
  ASSERT_EQ(view.lights.size(), 1u);
  view.camera.to_world[2][3] = 0.5;
  io::Image image;
  RenderStats stats;
  ASSERT_TRUE(render(world, view, options(64, 2, 2), image, stats).ok());
  MeanSum sum;
  for (std::size_t i = 1; i < image.pixels.size(); i += 4) sum.add(image.pixels[i]);
  expect_mean(sum.mean(), panel_radiance(panel(0.4, 1, 2)));
  EXPECT_EQ(stats.lights[0].occluded, 0u);
}

TEST(LightRays, EmissionIsSeenFromTheSideThatShines) {
  for (const bool double_sided : {false, true}) {
    for (const bool behind : {false, true}) {
      io::SceneFile scene = floor_scene();
      scene.materials[0].emission = {1, 2, 3};
      scene.materials[0].double_sided = double_sided;
      View view = {point_camera(), {}};
      if (behind) {  // looks up from below
        view.camera.to_world = {{{1, 0, 0, 0}, {0, -1, 0, 0}, {0, 0, -1, -5}}};
      }
      World world;
      ASSERT_TRUE(build_world(scene, {}, world).ok());
      io::Image image;
      RenderStats stats;
      ASSERT_TRUE(render(world, view, options(1, 1, 1), image, stats).ok());
      EXPECT_EQ(image.pixels[1], behind && !double_sided ? 0 : 2);
      EXPECT_EQ(image.pixels[3], 1);
    }
  }
}

TEST(LightRays, LightsThatCannotReachCostNoRay) {
  io::Light below = panel(0, -1, 1), away = panel(0, 1, 1);
  below.direction = {0, 0, 1};
  away.direction = {0, 0, 1};
  const Estimates e = estimate(floor_scene(), {below, away, panel(0, 1, 0)}, options(4, 1, 3), 0);
  EXPECT_EQ(e.stats.shadow().rays(), 0u);
  EXPECT_EQ(e.stats.lights[0].skipped_behind, 48u);
  EXPECT_EQ(e.stats.lights[1].skipped_emitter, 48u);
  EXPECT_EQ(e.stats.lights[2].skipped_no_power, 48u);
}

TEST(LightRays, EnvironmentIsSeenWhereNothingElseIs) {
  io::Light sky;
  sky.type = io::LightType::environment;
  sky.color = {1, 2, 3};
  const io::SceneFile empty;
  World world;
  ASSERT_TRUE(build_world(empty, {}, world).ok());
  io::Image image;
  RenderStats stats;
  ASSERT_TRUE(render(world, {point_camera(), {sky, sky}}, options(1, 4, 1), image, stats).ok());
  EXPECT_EQ(image.pixels, (std::vector<float>{2, 4, 6, 1})) << "the sum of both, opaque";
  EXPECT_EQ(stats.shadow().rays(), 0u);
}

TEST(LightRays, ImpossibleNumbersOfSamplesAreRefused) {
  EXPECT_EQ(check_options(options(1, 1, 0)).code(), StatusCode::invalid_argument);
  EXPECT_EQ(check_options(options(1, kMostSamples + 1, 1)).code(), StatusCode::invalid_argument);
  EXPECT_EQ(check_options(options(1, 1, kMostLightSamples + 1)).code(), StatusCode::invalid_argument);
  EXPECT_TRUE(check_options(options(1, kMostSamples, kMostLightSamples)).ok());
}

}  // namespace
}  // namespace umbrix::render
