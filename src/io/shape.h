// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "umbrix/io/scene_file.h"

namespace umbrix::io::detail {

/// What a primitive's vertices are made from: where they are by themselves, what morph targets add to that, and the
/// joints that carry them. All arrays are as long as `positions`, or empty. Never changes once made.
struct Shape {
  struct Target {
    std::vector<Float3> positions, normals, tangents;
  };
  std::vector<Float3> positions, normals;
  std::vector<Float4> tangents;
  std::vector<Target> targets;
  std::size_t influences = 0;  ///< a vertex; 0: no joint carries it
  std::vector<std::uint16_t> joints;
  std::vector<float> weights;  ///< not negative, of a vertex not all zero
};

/// Vertices that follow joints. They are in world space, but mirrored along x if most of the joints mirror: which side
/// of a triangle is its front is told by the instance's transform, here `to_world`, not by its vertices.
struct PosedShape {
  std::vector<Float3> positions, normals;
  std::vector<Float4> tangents;
  Transform to_world = kIdentity;
};

/// The shape with as much of each target as `morph_weights` says. `joints`: for each joint where it takes vertices to,
/// from where they are by themselves; if there are none, the shape stays in its own space.
PosedShape pose_shape(const Shape& shape, const std::vector<double>& morph_weights,
                      const std::vector<glm::dmat4>& joints);

}  // namespace umbrix::io::detail
