// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "command.h"
#include "table1/contestant.h"

namespace umbrix::bench {

/// One kernel on one scene and light.
struct TableRow {
  std::string scene;
  std::string kernel;
  std::size_t light = 0;
  BuildStats build;
  FrameResult result;  ///< of the counted run
  std::vector<double> seconds;
  std::vector<double> precompute_seconds;
  std::uint64_t wrong = 0;
};

/// One scene's rows, the first of which is what the others are compared with.
void print_table(const std::vector<TableRow>& rows);

nlohmann::json to_json(const std::vector<TableRow>& rows);

/// Nothing if `path` is empty.
ExitCode write_table_csv(const std::string& path, const std::vector<TableRow>& rows);

}  // namespace umbrix::bench
