// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

namespace umbrix::app {

/// Adds an option for a time from a second to a year: seconds, or "90s", "5m", "1.5h". `set` is given seconds.
CLI::Option* add_duration(CLI::App& app, const std::string& flag, const std::function<void(double)>& set,
                          const std::string& help);

}  // namespace umbrix::app
