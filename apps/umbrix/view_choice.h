// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "render/render.h"
#include "umbrix/io/scene_file.h"

namespace umbrix::app {

/// Where what a view shows is from.
struct ViewOrigin {
  std::string camera_file;
  std::vector<std::string> setup_files;  ///< all that the setup was read from
  bool scene_lights = false;             ///< the view's first lights are the scene's, in their order
};

/// What the command line says of it.
struct ViewChoice {
  const std::string& setup;   ///< a file; empty: none
  const std::string& camera;  ///< name or number; empty: the first
  bool mesh_lights;
};

/// Chooses camera and lights: those asked for, else the setup's, else the scene's, else ones that show the scene.
/// Emissive meshes light the scene beside any of these, if wanted. bad_input: the setup; invalid_argument: no such
/// camera.
Status choose_view(const io::SceneFile& scene, const ViewChoice& choice, render::View& view, ViewOrigin& origin);

/// width / height that the camera was made for; 16:9 if it does not say.
double natural_aspect(const io::Camera& camera);

}  // namespace umbrix::app
