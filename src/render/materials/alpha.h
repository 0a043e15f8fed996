// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "umbrix/io/scene_file.h"
#include "umbrix/opacity.h"

namespace umbrix::render {

/// Whether alpha takes no part in what rays meet of a mesh: its material is opaque, or cuts out nothing by what is
/// known without its texture.
bool is_solid(const io::SceneFile& file, const io::Mesh& mesh);

/// The mesh's alpha as rays meet it (glTF 2.0 section 3.9.4): factor times texture times vertex colours, cut off or
/// blended. `seed` tells meshes apart that blend.
Status make_alpha_test(const io::SceneFile& file, const io::Mesh& mesh, std::uint64_t seed, AlphaTest& out);

}  // namespace umbrix::render
