// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

namespace umbrix::app {

/// Adds --config FILE to a command: lines "flag = value", named as the command's flags are ("spp = 16", "half = true",
/// "output = [\"a.exr\", \"b.png\"]"). What is also on the command line is taken from there. To be added before the
/// command's other options.
void add_config_option(CLI::App& command);

}  // namespace umbrix::app
