// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "io/accessor.h"

namespace umbrix::io::detail {

/// Whether a node's mesh is placed by EXT_mesh_gpu_instancing.
bool has_gpu_instances(const tinygltf::Node& node);

/// How many times, by the word of the file; nothing is read.
std::uint64_t gpu_instance_count(const tinygltf::Node& node, const AccessorReader& reader, const std::string& label);

/// Where in the node. Throws LoadError.
std::vector<glm::dmat4> read_gpu_instances(const tinygltf::Node& node, AccessorReader& reader,
                                           const std::string& label);

}  // namespace umbrix::io::detail
