// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include "progress.h"

namespace umbrix::app {

/// Adds --progress. With `openjd`, failures are told as such lines as well.
void add_progress_option(CLI::App& command, ProgressStyle& style);

}  // namespace umbrix::app
