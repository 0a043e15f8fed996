// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "umbrix/io/scene_file.h"

namespace umbrix::io::detail {

/// A setup's camera, which stands still or has keyframes. Throws LoadError.
Camera read_setup_camera(const nlohmann::json& object);

}  // namespace umbrix::io::detail
