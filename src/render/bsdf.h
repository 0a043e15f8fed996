// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render/vec.h"
#include "umbrix/io/scene_file.h"

namespace umbrix::render {

/// The share of light from `wi` that leaves towards `wo`, per steradian, without the cosine. All unit vectors, pointing
/// away from the surface, the directions on the normal's side.
Rgb evaluate_bsdf(const io::Material& material, const Vec3& normal, const Vec3& wo, const Vec3& wi);

}  // namespace umbrix::render
