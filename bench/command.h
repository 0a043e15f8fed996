// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace umbrix::bench {

/// What the process returns, as the command line `umbrix` does.
enum ExitCode { kDone = 0, kFailed = 1, kUsage = 2, kBadInput = 3, kOutputFailed = 4 };

/// A sub-command: declares its options on `app` and returns what to do with them after parsing.
using Command = std::function<ExitCode()>(CLI::App& app);

Command stress_command, throughput_command, build_command, table1_command, depth_command, predictor_command,
    error_command;

}  // namespace umbrix::bench
