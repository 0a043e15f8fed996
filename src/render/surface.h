// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render/bsdf.h"
#include "render/vec.h"
#include "render/world.h"

namespace umbrix::render {

/// The point a ray hit, as shading and shadow rays need it. Both normals are on the side the ray came from: surfaces
/// are opaque and reflect the same on both sides, whatever doubleSided says (shadow rays see both sides too). What a
/// surface emits, it emits in front, and behind only if it is double-sided.
struct Surface {
  BsdfParameters bsdf;  ///< of the material at the point
  Rgb emission{0};      ///< radiance towards the viewer
  Vec3 point{0};        ///< world space
  Vec3 point_error{0};  ///< bounds how far `point` is from the triangle's plane, per axis
  Vec3 origin{0};       ///< where shadow rays start, in floats: `point`, moved off the surface by its rounding error
  Vec3 geometric_normal{0};  ///< unit
  Vec3 shading_normal{0};    ///< unit; interpolated if the mesh has normals
  Vec3 to_viewer{0};         ///< unit
  Primitive primitive;
};

/// Fills `surface` with where `ray` met `hit`.
void find_surface(const World& world, const Ray& ray, const Hit& hit, Surface& surface);

}  // namespace umbrix::render
