// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "render/render.h"
#include "umbrix/io/scene_file.h"

namespace umbrix::app {

/// Where what a view shows is from.
struct ViewOrigin {
  std::string camera_file;
  bool scene_lights = false;  ///< the view's first lights are the scene's, in their order
};

/// Chooses camera and lights: those asked for, else the setup's, else the scene's, else ones that show the scene.
/// Emissive meshes light the scene beside any of these, if wanted. `setup_path` and `camera` may be empty.
/// bad_input: the setup; invalid_argument: no such camera.
Status choose_view(const io::SceneFile& scene, const std::string& setup_path, const std::string& camera,
                   bool mesh_lights, render::View& view, ViewOrigin& origin);

/// width / height that the camera was made for; 16:9 if it does not say.
double natural_aspect(const io::Camera& camera);

}  // namespace umbrix::app
