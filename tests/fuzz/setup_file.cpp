// SPDX-License-Identifier: Apache-2.0
// Bytes as a setup file for a scene of one triangle.
#include "input_folder.h"
#include "loading.h"
#include "promise.h"
#include "umbrix/io/image_file.h"

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

// "sky.exr" lies beside the setup file.
void write_sky(const umbrix::fuzz::InputFolder& folder) {
  umbrix::io::Image image;
  image.width = 4;
  image.height = 2;
  image.channels = {"R", "G", "B"};
  image.pixels.assign(24, 0.5f);
  umbrix::fuzz::promise(umbrix::io::write_image(folder.path("sky.exr"), image, {}).ok(), "a map can be written");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace umbrix;
  static const fuzz::InputFolder folder;
  static const bool has_sky = (write_sky(folder), true);
  (void)has_sky;
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
