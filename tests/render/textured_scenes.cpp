// SPDX-License-Identifier: Apache-2.0
#include "textured_scenes.h"

namespace umbrix::render {

io::SceneFile card_scene() {
  io::Mesh mesh = quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  mesh.texcoord_sets[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  return scene_of(mesh);
}

std::int32_t add_texture(io::SceneFile& scene, std::uint32_t width, std::uint32_t height,
                         const std::vector<std::uint8_t>& pixels, const TexelSampler& sampler) {
  io::TextureImage image;
  image.width = width;
  image.height = height;
  image.channels = static_cast<std::uint32_t>(pixels.size() / width / height);
  image.pixels = pixels;
  scene.images.push_back(image);
  scene.textures.push_back({static_cast<std::int32_t>(scene.images.size()) - 1, sampler});
  return static_cast<std::int32_t>(scene.textures.size()) - 1;
}

}  // namespace umbrix::render
