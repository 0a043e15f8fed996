// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "command.h"
#include "umbrix/status.h"

namespace umbrix::bench {

/// Prints the one-line message and returns the exit code for it.
ExitCode fail(const Status& status);

/// Writes a report, replacing an older one; nothing if `path` is empty.
ExitCode write_json(const std::string& path, const nlohmann::json& report);

/// Where a scene's chart goes: of several scenes each has one of its own, name.svg becomes name-scene.svg.
std::string chart_path(const std::string& path, const std::string& scene, std::size_t scene_count);

/// The middle value; of an even number the mean of the two.
double median(std::vector<double> values);

/// Seconds of processor time that this thread has used.
double thread_seconds();

/// Seconds on a clock that never jumps.
double wall_seconds();

}  // namespace umbrix::bench
