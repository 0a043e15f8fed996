// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "error/figures.h"

namespace umbrix::bench {

/// A report of `umbrix-bench error` and its charts as one HTML page that needs nothing else, neither files nor scripts.
/// Its numbers are those of the report, which it holds as a download.
std::string page_of(const nlohmann::json& report, const std::vector<Figure>& figures);

}  // namespace umbrix::bench
