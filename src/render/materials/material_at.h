// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render/bsdf.h"
#include "render/materials/mesh_point.h"

namespace umbrix::render {

/// What a material is at a point: factors times textures times vertex colours.
struct MaterialPoint {
  BsdfParameters bsdf;
  Rgb emission{0};  ///< on the side that emits; of unlit materials what is seen on either side
};

MaterialPoint material_at(const MeshPoint& point);

/// The emission alone, as far as the surface is there at all: none where alpha cuts it out, less where it blends.
Rgb emission_at(const MeshPoint& point);

}  // namespace umbrix::render
