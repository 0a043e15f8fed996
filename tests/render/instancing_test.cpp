// SPDX-License-Identifier: Apache-2.0
// Whether instances share their mesh is no matter for a picture.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "built_scenes.h"
#include "render/shared_meshes.h"

namespace umbrix::render {
namespace {

/// A bowl of 2 * rings * 24 triangles that opens to +z, of radius 1.
io::Mesh bowl(std::uint32_t rings) {
  constexpr std::uint32_t kSegments = 24;
  io::Mesh mesh;
  for (std::uint32_t i = 0; i <= rings; ++i)
    for (std::uint32_t j = 0; j < kSegments; ++j) {
      const double r = 0.1 + 0.9 * i / rings, angle = 6.283185307179586 * j / kSegments;
      mesh.positions.push_back({static_cast<float>(r * std::cos(angle)), static_cast<float>(r * std::sin(angle)),
                                static_cast<float>(0.5 * r * r)});
      mesh.normals.push_back({static_cast<float>(-r * std::cos(angle)), static_cast<float>(-r * std::sin(angle)), 1});
    }
  for (std::uint32_t i = 0; i < rings; ++i)
    for (std::uint32_t j = 0; j < kSegments; ++j) {
      const std::uint32_t a = i * kSegments + j, b = i * kSegments + (j + 1) % kSegments;
      mesh.triangles.push_back({a, a + kSegments, b + kSegments});
      mesh.triangles.push_back({a, b + kSegments, b});
    }
  return mesh;
}

io::Transform turned(double angle, double scale, const io::Double3& to) {
  const double c = scale * std::cos(angle), s = scale * std::sin(angle);
  return {{{c, -s, 0.1, to[0]}, {s, c, 0.2, to[1]}, {0, 0.3 * scale, scale, to[2]}}};
}

/// Bowls over a floor, some of them mirrored and one squashed flat; lights of all types, one of them a shared mesh.
Clutter bowls() {
  Clutter made = clutter(9);
  io::SceneFile& scene = made.scene;
  scene.materials.resize(2);
  scene.materials[1].emission = {2, 3, 4};
  const auto first = static_cast<std::uint32_t>(scene.meshes.size());
  scene.meshes.push_back(bowl(4));
  scene.meshes.push_back(bowl(2));
  scene.meshes.back().material = 1;
  for (int i = 0; i < 12; ++i) {
    io::Transform m = turned(i, 0.2 + 0.05 * (i % 4), {0.5 * (i % 4) - 0.8, 0.6 * (i / 4) - 0.6, 0.3 + 0.1 * (i % 3)});
    if (i % 5 == 2)
      for (auto& row : m) row[0] = -row[0];
    if (i == 7) m[2] = {0, 0, 0, 0.4};
    place(scene, first, m);
  }
  place(scene, first + 1, turned(1, 0.4, {-1, 0.5, 2}));
  place(scene, first + 1, turned(2, 0.3, {1, -0.5, 2}));
  io::Light sky;
  sky.type = io::LightType::environment;
  made.view.lights.push_back(sky);
  for (const io::Light& light : io::emissive_lights(scene)) made.view.lights.push_back(light);
  return made;
}

io::Image picture(const Clutter& made, Instancing instancing, std::uint64_t& instances, const char* kernel) {
  World world;
  EXPECT_TRUE(build_world(made.scene, {}, world, instancing).ok());
  instances = world.scene.build_stats().instances;
  RenderOptions options;
  options.width = 120;
  options.height = 80;
  options.samples = 2;
  options.aovs = {"normal", "depth", "shadow"};
  FrameTracer tracer;
  if (kernel) {
    EXPECT_TRUE(find_kernel(kernel, options.kernel).ok());
  } else {
    EXPECT_TRUE(tracer.start(world.scene).ok());
    options.tracer = &tracer;
  }
  io::Image image;
  RenderStats stats;
  EXPECT_TRUE(render(world, made.view, options, image, stats).ok());
  return image;
}

TEST(Instancing, PictureIsTheSame) {
  const Clutter made = bowls();
  for (const char* kernel : {static_cast<const char*>(nullptr), "auto", "standard"}) {
    std::uint64_t shared = 0, flattened = 0;
    const io::Image a = picture(made, Instancing::flatten, flattened, kernel);
    const io::Image b = picture(made, Instancing::share, shared, kernel);
    EXPECT_EQ(flattened, 0u);
    EXPECT_EQ(shared, 13u) << "all but the flat one";
    ASSERT_EQ(a.pixels.size(), b.pixels.size());
    EXPECT_EQ(std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(float)), 0);
  }
}

TEST(Instancing, WorldsAreAsLargeAsTheySay) {
  const Clutter made = bowls();
  std::uint64_t vertices = 0;
  World world;
  ASSERT_TRUE(build_world(made.scene, {}, world, Instancing::share).ok());
  for (const WorldMesh& mesh : world.meshes) vertices += mesh.positions.size();
  const WorldSize size = world_size(made.scene, Instancing::share);
  EXPECT_EQ(size.placed_vertices, vertices);
  EXPECT_EQ(size.shared_triangles, 4u * 48 + 2u * 48);
  EXPECT_EQ(size.sharing_instances, 14u);
  EXPECT_EQ(size.placed_triangles + 12 * 4 * 48 + 2 * 2 * 48, made.scene.instanced_triangles());
}

TEST(Instancing, LargeScenesShareByThemselves) {
  Clutter made = bowls();
  const auto is_shared = [&] { return world_size(made.scene, Instancing::automatic).sharing_instances > 0; };
  EXPECT_FALSE(is_shared());
  const auto bowl = static_cast<std::uint32_t>(made.scene.meshes.size() - 2);
  for (int i = 0; i < 6000; ++i) place(made.scene, bowl);
  EXPECT_TRUE(is_shared());
  EXPECT_EQ(world_size(made.scene, Instancing::flatten).sharing_instances, 0u);
}

}  // namespace
}  // namespace umbrix::render
