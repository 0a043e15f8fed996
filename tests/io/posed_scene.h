// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "gltf_text.h"

namespace umbrix::io::testing {

/// Sine and cosine of an eighth of a turn: a quaternion of them turns by a quarter.
inline const float kSqrtHalf = std::sqrt(0.5f);

using Numbers = std::vector<std::uint32_t>;

/// Loads what must load.
SceneFile load(const Gltf& g);

/// Moves a scene that must be movable.
SceneChanges pose(SceneFile& scene, double seconds);

/// A vertex of an instance, in the world.
Double3 corner(const SceneFile& scene, std::size_t instance, std::size_t vertex);

void expect_near(const Double3& is, const Double3& wanted);

/// Adds an animation of the morph weights of a node's mesh.
void animate_weights(Gltf& g, int node, const std::vector<float>& times, const std::vector<float>& values,
                     const char* interpolation = "LINEAR");

}  // namespace umbrix::io::testing
