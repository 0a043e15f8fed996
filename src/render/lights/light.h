// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render/vec.h"
#include "umbrix/io/scene_file.h"

namespace umbrix::render {

/// Why a light sends a point nothing, known without a ray.
enum class Unreached { no, beyond_range, outside_cone, no_power };

/// Light on its way to a point.
struct Arrival {
  Unreached unreached = Unreached::no;
  Vec3 to_light{0};   ///< from the point; its end, at t = 1, is the light, unless tmax is infinite
  float tmax = 1;     ///< where the shadow ray ends: 1, or infinity for a light without a place
  Rgb irradiance{0};  ///< on a surface that faces the light
};

/// What a type of light does. Adding one is a file with a LightKind and a line in umbrix/io/light_types.h.
struct LightKind {
  Arrival (*arrive)(const io::Light& light, const Vec3& point);
};

const LightKind& light_kind(io::LightType type);

/// A point light's arrival: inverse square, and the range window that KHR_lights_punctual recommends. Lights with a
/// place build on it.
Arrival arrive_from_position(const io::Light& light, const Vec3& point);

}  // namespace umbrix::render
