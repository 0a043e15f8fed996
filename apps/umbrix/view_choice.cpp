// SPDX-License-Identifier: Apache-2.0
#include "view_choice.h"

#include <fmt/format.h>

#include "strict_number.h"

namespace umbrix::app {
namespace {

Status find_camera(const io::SceneFile& scene, const std::string& wanted, io::Camera& out) {
  std::string names;
  for (const io::Camera& camera : scene.cameras) {
    if (camera.name == wanted) {
      out = camera;
      return {};
    }
    names += fmt::format("{}'{}'", names.empty() ? "" : ", ", camera.name);
  }
  std::uint64_t number = 0;
  if (parse_number(wanted, number) && number < scene.cameras.size()) {
    out = scene.cameras[number];
    return {};
  }
  return {StatusCode::invalid_argument, fmt::format("{}: --camera: there is no camera '{}'; {}", scene.path, wanted,
                                                    names.empty() ? "the file has none" : "the file has " + names)};
}

}  // namespace

Status choose_view(const io::SceneFile& scene, const ViewChoice& choice, render::View& view, ViewOrigin& origin) {
  io::Setup setup;
  origin.camera_file = scene.path;
  if (!choice.setup.empty()) {
    if (Status status = io::load_setup(choice.setup, scene, setup); !status) return status;
  }
  if (!choice.camera.empty()) {
    if (Status status = find_camera(scene, choice.camera, view.camera); !status) return status;
  } else if (setup.camera) {
    view.camera = *setup.camera;
    origin.camera_file = choice.setup;
  } else {
    view.camera = scene.cameras.empty() ? io::framing_camera(scene) : scene.cameras.front();
  }
  origin.scene_lights = setup.lights.empty();
  origin.setup_files = setup.files;
  view.lights = setup.lights.empty() ? scene.lights : setup.lights;
  if (choice.mesh_lights) {
    for (io::Light& light : io::emissive_lights(scene)) view.lights.push_back(std::move(light));
  }
  if (view.lights.empty()) view.lights = io::default_lights(scene, view.camera);
  return {};
}

double natural_aspect(const io::Camera& camera) {
  if (camera.type == io::CameraType::orthographic) return camera.xmag / camera.ymag;
  return camera.aspect > 0 ? camera.aspect : 16.0 / 9.0;
}

}  // namespace umbrix::app
