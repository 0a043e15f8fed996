// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "io/accessor.h"

namespace umbrix::io::detail {

/// How vertices lie in each joint of a skin. Throws LoadError.
std::vector<glm::dmat4> read_inverse_bind(const tinygltf::Skin& skin, AccessorReader& reader, const std::string& label);

}  // namespace umbrix::io::detail
