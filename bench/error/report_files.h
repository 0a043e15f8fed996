// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "umbrix/status.h"

namespace umbrix::bench {

/// Where a report goes; what is empty is not written. Older files are replaced.
struct ReportFiles {
  std::string json;
  std::string html;
  std::string folder;  ///< made if it is not there: index.html, and each chart as SVG, and as PNG if librsvg was found
};

/// Fails with output_failed, naming the file.
Status write_report(const nlohmann::json& report, const ReportFiles& files);

/// Reads what write_report wrote as JSON. bad_input names the file.
Status read_report(const std::string& path, nlohmann::json& out);

}  // namespace umbrix::bench
