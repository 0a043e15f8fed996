// SPDX-License-Identifier: Apache-2.0
// Bytes as a setup file for a scene of one triangle.
#include "input_folder.h"
#include "loading.h"
#include "promise.h"

namespace {

umbrix::io::SceneFile one_triangle() {
  umbrix::io::SceneFile scene;
  scene.path = "triangle.glb";
  scene.materials.resize(1);
  scene.meshes.resize(1);
  scene.meshes[0].positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  scene.meshes[0].triangles = {{0, 1, 2}};
  scene.instances.resize(1);
  return scene;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace umbrix;
  static const fuzz::InputFolder folder;
  static const io::SceneFile scene = one_triangle();
  io::Setup setup;
  const Status status = io::load_setup(folder.write("setup.json", data, size), scene, setup);
  if (!status) {
    fuzz::check_refusal(status);
    fuzz::promise(!setup.camera && setup.lights.empty(), "nothing is left of a refused setup");
    return 0;
  }
  fuzz::promise(setup.camera || !setup.lights.empty(), "a setup has a camera or lights");
  if (setup.camera) fuzz::check_camera(*setup.camera);
  for (const io::Light& light : setup.lights) fuzz::check_light(light);
  return 0;
}
