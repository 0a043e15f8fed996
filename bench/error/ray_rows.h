// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "error/ray_errors.h"

namespace umbrix::bench {

/// One row for each peer and set of rays: rates a million of all its rays with 95 % intervals, speed with quartiles.
nlohmann::json ray_rows(const std::string& scene, const std::vector<RayErrors>& sets);

/// The same over several scenes, named "all scenes": counts are summed, speeds are geometric means.
nlohmann::json pooled_rows(const nlohmann::json& rows);

}  // namespace umbrix::bench
