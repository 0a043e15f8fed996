// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render/materials/mesh_point.h"

namespace umbrix::render {

/// What a texture gives at a point.
struct Rgba {
  Rgb color{1};
  double alpha = 1;
};

/// How an image's colours are stored; alpha is linear always.
enum class Transfer { linear, srgb };

/// The image that a texture in use is of.
const io::TextureImage& image_of(const io::SceneFile& file, const io::TextureUse& use);

/// Whether a use of a texture leads to an image that is read, and the mesh has the coordinates.
bool has_texture(const io::SceneFile& file, const io::Mesh& mesh, const io::TextureUse& use);

/// The texture at the point, linear; white if it is not there.
Rgba texture_at(const MeshPoint& point, const io::TextureUse& use, Transfer transfer);

}  // namespace umbrix::render
