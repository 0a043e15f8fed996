// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "built_scenes.h"

namespace umbrix::render {

/// A square from (0, 0) to (1, 1) in z = 0 with an image upright on it, not yet placed.
io::SceneFile card_scene();

/// A texture of an image of 8 bits, rows from the top; the index is for TextureUse::texture.
std::int32_t add_texture(io::SceneFile& scene, std::uint32_t width, std::uint32_t height,
                         const std::vector<std::uint8_t>& pixels, const TexelSampler& sampler = {});

}  // namespace umbrix::render
