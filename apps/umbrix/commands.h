// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <vector>

namespace umbrix::app {

/// A sub-command that was added to the program, and what runs it; `run` returns the exit code.
struct Command {
  CLI::App* parser;
  std::function<int()> run;
};

Command add_render_command(CLI::App& program);
Command add_info_command(CLI::App& program);
Command add_kernels_command(CLI::App& program);
Command add_merge_command(CLI::App& program);
Command add_compare_command(CLI::App& program);

}  // namespace umbrix::app
