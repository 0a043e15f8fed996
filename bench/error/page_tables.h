// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace umbrix::bench {

/// Of each scene: the fastest of each family on ordinary rays, and the rates of wrong answers.
std::string summary_table(const nlohmann::json& report);

/// All numbers of a scene, to be opened one by one.
std::vector<std::string> scene_tables(const nlohmann::json& report, const std::string& scene);

}  // namespace umbrix::bench
