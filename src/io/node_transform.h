// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>

#include "io/tinygltf.h"
#include "umbrix/io/scene_file.h"

namespace umbrix::io::detail {

/// A node's place in its parent, in parts: scaled, then rotated, then moved.
struct Pose {
  glm::dvec3 translation = glm::dvec3(0);
  glm::dquat rotation = glm::dquat(1, 0, 0, 0);
  glm::dvec3 scale = glm::dvec3(1);
};

/// The parts that a node without a matrix gives, the others as they are at rest.
Pose pose_of(const tinygltf::Node& node);

/// Throws LoadError if the rotation has no length.
glm::dmat4 to_matrix(const Pose& pose, const std::string& label);

/// A node's place in its parent, from its matrix or its parts.
glm::dmat4 local_transform(const tinygltf::Node& node, const std::string& label);

bool is_finite(const glm::dmat4& m);

Transform to_transform(const glm::dmat4& m);

/// `v` at unit length, also if its square does not fit. Throws LoadError if it is zero; `what` is for the message.
glm::dvec3 direction(const glm::dvec3& v, const char* what, const std::string& label);

/// A camera's frame without its scale and shear: the view axis stays, "up" is made normal to it.
Transform camera_frame(const glm::dmat4& m, const std::string& label);

/// Puts a light where a node is; its direction is the node's -z. Throws LoadError if that is zero.
void place_light(const glm::dmat4& m, const std::string& label, Light& light);

}  // namespace umbrix::io::detail
