// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <exception>
#include <sstream>
#include <string>
#include <vector>

#include "commands.h"
#include "exit_code.h"
#include "memory_guard.h"
#include "message.h"
#include "signals.h"
#include "standard_streams.h"
#include "umbrix/umbrix.h"

namespace umbrix::app {
namespace {

std::string version_text() {
  std::string text = std::string("umbrix ") + version_string() + "\nSIMD targets:";
  for (std::size_t i = 0; i < simd_target_count(); ++i) text += std::string(" ") + simd_target_name(i);
  return text;
}

/// CLI11 has a code for each way to be wrong; scripts want one.
int report_usage(const CLI::App& program, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) {
    std::ostringstream text;
    program.exit(error, text, text);
    return report_status(print_result(text.str()));
  }
  say_error(error.what());
  say("Run 'umbrix --help', or 'umbrix COMMAND --help', for what there is.");
  return kUsage;
}

int run(int argc, char** argv) {
  CLI::App program("Umbrix: exact shadow rays for glTF scenes", "umbrix");
  program.set_version_flag("--version", version_text);
  program.require_subcommand(1);
  program.footer(
      "Exit codes: 0 complete, 1 failed, 2 bad command line, 3 bad input, 4 output cannot be written,\n"
      "5 incomplete, 6 out of memory or beyond a limit, 129, 130 and 143 interrupted,\n"
      "141 nobody reads the output any more.");
  const std::vector<Command> commands = {add_render_command(program), add_merge_command(program),
                                         add_compare_command(program), add_info_command(program),
                                         add_kernels_command(program)};
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return report_usage(program, error);
  }
  for (const Command& command : commands) {
    if (command.parser->parsed()) return command.run();
  }
  return kUsage;
}

}  // namespace
}  // namespace umbrix::app

int main(int argc, char** argv) {
  umbrix::app::fill_standard_streams();
  umbrix::app::guard_memory();
  umbrix::app::catch_signals();
  try {
    return umbrix::app::run(argc, argv);
  } catch (const std::exception& error) {
    umbrix::app::say_error(error.what());
    return umbrix::app::is_lack_of_memory(error) ? umbrix::app::kResourceLimit : umbrix::app::kFailed;
  }
}
