// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "umbrix/io/scene_file.h"

namespace umbrix::io::detail {

/// What a setup file's lights are read with.
struct SetupContext {
  const std::string& path;  ///< the setup file's
  const SceneFile& scene;
  const LoadLimits& limits;
};

/// The lights of a setup's "lights". Throws LoadError.
std::vector<Light> read_setup_lights(const nlohmann::json& array, const SetupContext& context);

}  // namespace umbrix::io::detail
