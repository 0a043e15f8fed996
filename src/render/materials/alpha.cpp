// SPDX-License-Identifier: Apache-2.0
#include "render/materials/alpha.h"

#include "render/materials/texture.h"

namespace umbrix::render {
namespace {

/// Whether the base colour's texture has alpha at all.
bool has_alpha_texture(const io::SceneFile& file, const io::Mesh& mesh, const io::Material& material) {
  const io::TextureUse& use = material.base_color_texture;
  return has_texture(file, mesh, use) && image_of(file, use).channels % 2 == 0;
}

}  // namespace

bool is_solid(const io::SceneFile& file, const io::Mesh& mesh) {
  const io::Material& material = file.materials[mesh.material];
  if (material.alpha_mode == io::AlphaMode::opaque) return true;
  if (has_alpha_texture(file, mesh, material) || !mesh.colors.empty()) return false;
  return material.alpha >= (material.alpha_mode == io::AlphaMode::mask ? material.alpha_cutoff : 1);
}

Status make_alpha_test(const io::SceneFile& file, const io::Mesh& mesh, std::uint64_t seed, AlphaTest& out) {
  const io::Material& material = file.materials[mesh.material];
  AlphaMap map;
  map.factor = material.alpha;
  map.cutoff = material.alpha_cutoff;
  map.stochastic = material.alpha_mode == io::AlphaMode::blend;
  map.seed = seed;
  map.indices = mesh.triangles.data()->data();
  map.triangle_count = mesh.triangles.size();
  map.vertex_count = mesh.positions.size();
  if (!mesh.colors.empty()) {
    map.vertex_alpha = &mesh.colors.front()[3];
    map.vertex_alpha_stride = sizeof(io::Float4);
  }
  if (has_alpha_texture(file, mesh, material)) {
    const io::TextureUse& use = material.base_color_texture;
    const io::TextureImage& image = image_of(file, use);
    map.image = image.pixels.data() + (image.channels - 1);
    map.width = image.width;
    map.height = image.height;
    map.pixel_stride = image.channels;
    map.sampler = file.textures[static_cast<std::size_t>(use.texture)].sampler;
    map.texcoords = mesh.texcoord_sets[use.texcoord].data()->data();
    for (std::size_t row = 0; row < 2; ++row) {
      for (std::size_t c = 0; c < 3; ++c) map.transform[row][c] = use.transform[row][c];
    }
  }
  return out.set(map);
}

}  // namespace umbrix::render
