// SPDX-License-Identifier: Apache-2.0
// A picture has no unit of length: a scene, its camera and its lights that grow by a power of two, with intensities by
// its square, give the same pixels to the last bit, and depths that grow with them.
#include <gtest/gtest.h>

#include <cmath>

#include "built_scenes.h"

namespace umbrix::render {
namespace {

/// Clutter and a turned, unevenly stretched copy of it; lights with ranges.
Clutter still_life() {
  Clutter made = clutter(9);
  const double c = std::cos(0.7), s = std::sin(0.7);
  place(made.scene, 0, {{{0.4 * c, -0.3 * s, 0, 0.8}, {0.4 * s, 0.3 * c, 0.1, -0.5}, {0, 0.05, 0.7, 0.2}}});
  made.view.lights[0].range = 4;
  made.view.lights[1].range = 7;
  return made;
}

Clutter scaled(const Clutter& original, int exponent) {
  Clutter made = original;
  for (io::Mesh& mesh : made.scene.meshes) {
    for (io::Float3& position : mesh.positions) {
      for (float& x : position) x = std::ldexp(x, exponent);
    }
  }
  for (io::Instance& instance : made.scene.instances) {
    for (auto& row : instance.to_world) row[3] = std::ldexp(row[3], exponent);
  }
  for (auto& row : made.view.camera.to_world) row[3] = std::ldexp(row[3], exponent);
  for (io::Light& light : made.view.lights) {
    if (light.type != io::LightType::directional) light.intensity = std::ldexp(light.intensity, 2 * exponent);
    light.range = std::ldexp(light.range, exponent);
    for (double& x : light.position) x = std::ldexp(x, exponent);
  }
  return made;
}

io::Image picture(const Clutter& clutter) {
  World world;
  EXPECT_TRUE(build_world(clutter.scene, {}, world).ok());
  RenderOptions options;
  options.width = 120;
  options.height = 80;
  options.samples = 2;
  options.aovs = {"depth", "normal", "albedo", "shadow"};
  io::Image image;
  RenderStats stats;
  const Status status = render(world, clutter.view, options, image, stats);
  EXPECT_TRUE(status.ok()) << status.message();
  EXPECT_GT(stats.shadow().occluded, 1000u);
  EXPECT_GT(stats.shadow().unoccluded, 1000u);
  return image;
}

TEST(Scale, PicturesDoNotDependOnTheUnitOfLength) {
  const Clutter original = still_life();
  const io::Image expected = picture(original);
  for (const int exponent : {-60, -40, -20, -1, 20, 40, 60}) {
    SCOPED_TRACE("2^" + std::to_string(exponent));
    const io::Image image = picture(scaled(original, exponent));
    ASSERT_EQ(image.pixels.size(), expected.pixels.size());
    const std::size_t channels = image.channels.size();
    std::size_t different = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      const bool depth = image.channels[i % channels] == "depth.Z";
      different += image.pixels[i] != (depth ? std::ldexp(expected.pixels[i], exponent) : expected.pixels[i]);
    }
    EXPECT_EQ(different, 0u);
  }
}

}  // namespace
}  // namespace umbrix::render
