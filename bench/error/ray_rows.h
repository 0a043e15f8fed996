// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "error/ray_errors.h"
#include "error/statistics.h"

namespace umbrix::bench {

/// {"value", "low", "high"}, each rounded to five digits.
nlohmann::json estimate_json(const Estimate& estimate, double factor = 1);

/// One row for each peer and kind of rays: counts, rates a million rays with 95 % intervals, speed with quartiles; for
/// adversarial rays also the counts and speed by aim ("aims").
nlohmann::json ray_rows(const std::string& scene, const std::vector<RayErrors>& sets);

/// The same over several scenes, named "all scenes": counts are summed, speeds are geometric means.
nlohmann::json pooled_rows(const nlohmann::json& rows);

}  // namespace umbrix::bench
