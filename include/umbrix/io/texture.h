// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "umbrix/texels.h"

namespace umbrix::io {

/// How a picture of the file is looked at: glTF's texture with its sampler. Mipmaps are not made.
struct Texture {
  std::int32_t image = -1;  ///< in SceneFile::images; -1: none in a format that is read
  TexelSampler sampler;
};

/// A material's use of a texture.
struct TextureUse {
  std::int32_t texture = -1;   ///< in SceneFile::textures; -1: none
  std::uint32_t texcoord = 0;  ///< the set of texture coordinates: 0 or 1
  /// From the mesh's coordinates to the image's, rows for u and v (KHR_texture_transform).
  std::array<std::array<double, 3>, 2> transform{{{1, 0, 0}, {0, 1, 0}}};
};

/// A picture of the file, encoded until read_textures is asked for it. Coordinates (0, 0) are its upper left corner.
struct TextureImage {
  std::string name;
  std::string file;  ///< beside the scene file; empty if the scene file holds it
  std::shared_ptr<const std::vector<unsigned char>> encoded;  ///< what the scene file holds; null once read
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t channels = 0;        ///< grey, grey and alpha, red-green-blue, or with alpha, not multiplied by it
  std::vector<std::uint8_t> pixels;  ///< width * height * channels, rows from the top; empty: not read, or unreadable
};

}  // namespace umbrix::io
