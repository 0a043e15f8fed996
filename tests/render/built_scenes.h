// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "render/render.h"
#include "umbrix/io/scene_file.h"

namespace umbrix::render {

/// A quad of two triangles that share the diagonal 0-2, counter-clockwise.
io::Mesh quad(const io::Float3& a, const io::Float3& b, const io::Float3& c, const io::Float3& d);

/// A scene of one mesh and material 0 (white, rough, not metallic), not yet placed.
io::SceneFile scene_of(const io::Mesh& mesh);

/// Places mesh `index`.
void place(io::SceneFile& scene, std::uint32_t index, const io::Transform& to_world = io::kIdentity);

/// At (0, 0, height) looking straight down; +y is up in the image.
io::Camera camera_from_above(double height, double yfov);

io::Light point_light(const io::Double3& position, float candela);

/// A floor with random triangles of all sizes above it, and a point, a spot and a directional light.
struct Clutter {
  io::SceneFile scene;
  View view;
};
Clutter clutter(std::uint32_t seed);

}  // namespace umbrix::render
