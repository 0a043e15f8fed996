// SPDX-License-Identifier: Apache-2.0
#include "built_scenes.h"

#include <random>

namespace umbrix::render {

io::Mesh quad(const io::Float3& a, const io::Float3& b, const io::Float3& c, const io::Float3& d) {
  io::Mesh mesh;
  mesh.positions = {a, b, c, d};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

io::SceneFile scene_of(const io::Mesh& mesh) {
  io::SceneFile scene;
  scene.path = "built.gltf";
  scene.meshes = {mesh};
  scene.materials.resize(1);
  scene.materials[0].metallic = 0;
  return scene;
}

void place(io::SceneFile& scene, std::uint32_t index, const io::Transform& to_world) {
  io::Instance instance;
  instance.mesh = index;
  instance.to_world = to_world;
  scene.instances.push_back(instance);
}

io::Camera camera_from_above(double height, double yfov) {
  io::Camera camera;
  camera.yfov = yfov;
  camera.to_world[2][3] = height;
  return camera;
}

io::Light point_light(const io::Double3& position, float candela) {
  io::Light light;
  light.position = position;
  light.intensity = candela;
  return light;
}

Clutter clutter(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place_at(-1, 1), size(0.02f, 0.4f);
  io::Mesh mesh;
  for (std::uint32_t i = 0; i < 300; ++i) {
    const io::Float3 centre = {place_at(random), place_at(random), 0.6f + 0.5f * place_at(random)};
    const float extent = size(random);
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      mesh.positions.push_back({centre[0] + extent * place_at(random), centre[1] + extent * place_at(random),
                                centre[2] + extent * place_at(random)});
    }
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }

  Clutter made;
  made.scene = scene_of(mesh);
  made.scene.meshes.push_back(quad({-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}));
  place(made.scene, 0);
  place(made.scene, 1);
  made.view.camera = camera_from_above(4, 0.8);
  made.view.lights = {point_light({0.3, 0.2, 2.5}, 6), point_light({-1, 0.5, 2}, 9), io::Light()};
  made.view.lights[1].type = io::LightType::spot;
  made.view.lights[1].direction = {0.4472135954999579, 0, -0.8944271909999159};
  made.view.lights[2].type = io::LightType::directional;
  made.view.lights[2].direction = {0.6, 0, -0.8};
  return made;
}

}  // namespace umbrix::render
