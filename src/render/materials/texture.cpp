// SPDX-License-Identifier: Apache-2.0
#include "render/materials/texture.h"

#include <array>
#include <cmath>

namespace umbrix::render {
namespace {

/// IEC 61966-2-1. Rounded to float, which takes off what libraries differ in.
std::array<double, 256> srgb_table() {
  std::array<double, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double c = static_cast<double>(i) / 255;
    table[i] = static_cast<double>(static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4)));
  }
  return table;
}

std::array<double, 256> linear_table() {
  std::array<double, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) table[i] = static_cast<double>(i) / 255;
  return table;
}

const std::array<double, 256> kFromSrgb = srgb_table(), kFromLinear = linear_table();

}  // namespace

const io::TextureImage& image_of(const io::SceneFile& file, const io::TextureUse& use) {
  const io::Texture& texture = file.textures[static_cast<std::size_t>(use.texture)];
  return file.images[static_cast<std::size_t>(texture.image)];
}

bool has_texture(const io::SceneFile& file, const io::Mesh& mesh, const io::TextureUse& use) {
  return use.texture >= 0 && !mesh.texcoord_sets[use.texcoord].empty() && !image_of(file, use).pixels.empty();
}

Rgba texture_at(const MeshPoint& point, const io::TextureUse& use, Transfer transfer) {
  if (!has_texture(point.file, point.mesh, use)) return {};
  double uv[2], at[2];
  point.blend(point.mesh.texcoord_sets[use.texcoord], uv);
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const std::array<double, 3>& row = use.transform[axis];
    at[axis] = row[0] * uv[0] + row[1] * uv[1] + row[2];
  }
  const io::TextureImage& image = image_of(point.file, use);
  const TexelSampler& sampler = point.file.textures[static_cast<std::size_t>(use.texture)].sampler;
  const TexelQuad quad = texels_at(sampler, image.width, image.height, at[0], at[1]);
  const std::array<double, 256>& color = transfer == Transfer::srgb ? kFromSrgb : kFromLinear;
  const auto pixel = [&](std::uint32_t x, std::uint32_t y) {
    return &image.pixels[(std::size_t{y} * image.width + x) * image.channels];
  };
  Rgba out;
  out.color = quad.blend([&](std::uint32_t x, std::uint32_t y) {
    const std::uint8_t* p = pixel(x, y);
    return image.channels < 3 ? Rgb(color[p[0]]) : Rgb(color[p[0]], color[p[1]], color[p[2]]);
  });
  if (image.channels % 2 == 0) {
    out.alpha =
        quad.blend([&](std::uint32_t x, std::uint32_t y) { return kFromLinear[pixel(x, y)[image.channels - 1]]; });
  }
  return out;
}

}  // namespace umbrix::render
