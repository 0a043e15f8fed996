// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace umbrix::bench {

/// A chart of a report.
struct Figure {
  std::string name;         ///< of its files, without an extension
  std::string scene;        ///< that it shows
  std::string title;        ///< one line
  std::string description;  ///< for those who cannot see it: what is drawn and what it shows
  std::string svg;
};

/// The charts of a report of `umbrix-bench error`: of each scene and kind of rays, rates of wrong answers over speed;
/// of each scene with images, RMSE and relMSE over time.
std::vector<Figure> draw_figures(const nlohmann::json& report);

/// The scenes of the report's rows in their order, "all scenes" first where several are pooled.
std::vector<std::string> scenes_of(const nlohmann::json& report);

}  // namespace umbrix::bench
