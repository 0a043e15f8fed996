// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render/materials/mesh_point.h"

namespace umbrix::render {

/// The normal texture's normal in world space, not of unit length, on the side that the triangle's front is; zero if
/// the material has no such texture or the mesh no coordinates that could turn it. `normal` is the interpolated normal
/// in the mesh's space, `turned` the same in world space.
Vec3 mapped_normal(const MeshPoint& point, const io::Transform& to_world, const Vec3& normal, const Vec3& turned);

}  // namespace umbrix::render
