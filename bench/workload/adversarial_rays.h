// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "umbrix/ray.h"
#include "umbrix/status.h"
#include "workload/geometry.h"

namespace umbrix::workload {

/// What rays are aimed at to be hard to answer.
enum class Aim {
  vertex,   ///< a corner of a triangle
  edge,     ///< a point of an edge
  grazing,  ///< the inside of a triangle, at 1e-7 to 0.1 radians to its plane
  origin,   ///< they start on a triangle: at a corner, on an edge or inside
  end       ///< tmin or tmax is at most two floats from a hit
};

constexpr Aim kAims[] = {Aim::vertex, Aim::edge, Aim::grazing, Aim::origin, Aim::end};

/// "vertex", "edge", "grazing", "origin", "end".
const char* aim_name(Aim aim);

/// Rays at random triangles of the scene, each as likely as the others, from random directions and 0.5 to 5.5 % of the
/// scene's diagonal away. All values are floats, so no ray meets its target but for rounding; directions are
/// normalised. The interval is +-0.1 % of the distance around the target (vertex, edge), +-50 % (grazing), from the
/// origin on (origin), or ends in +-2 floats of the hit (end). The same seed makes the same rays. bad_input if
/// the scene has no triangles.
Status adversarial_rays(const Geometry& geometry, Aim aim, std::size_t count, std::uint64_t seed,
                        std::vector<Ray>& out);

}  // namespace umbrix::workload
