// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>

namespace umbrix::app {

/// Three quarters of what the machine has, or of what a control group leaves to its processes; 0 if neither tells.
std::uint64_t default_memory_limit();

/// Adds --memory-limit, which sets `bytes` (0: no limit) and keeps it as it is if it is not given.
void add_memory_limit_option(CLI::App& command, std::uint64_t& bytes);

}  // namespace umbrix::app
