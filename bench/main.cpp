// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <utility>
#include <vector>

#include "command.h"

namespace {

using namespace umbrix::bench;

struct Entry {
  const char* name;
  const char* summary;
  Command* declare;
};

constexpr Entry kCommands[] = {
    {"stress", "Judge every kernel, and Embree, on hard rays by exact arithmetic", stress_command},
    {"throughput", "Shadow rays per second of every kernel and of Embree, on the same rays", throughput_command},
    {"build", "Build time and memory, against Embree", build_command},
    {"table1", "Tests a ray, time and memory of every kernel in a frame: the table of Liang & Huang (2019)",
     table1_command},
    {"depth", "How deep in the tree lists of likely blockers end rays, and at what cost", depth_command},
    {"predictor", "How often a frame tracer guesses right, over the size of its regions and cells", predictor_command},
    {"error", "Wrong answers, and the error of images, against time: a report with charts", error_command},
};

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Umbrix against the truth and against Embree", "umbrix-bench");
  app.require_subcommand(1);
  std::vector<std::pair<CLI::App*, std::function<ExitCode()>>> commands;
  for (const Entry& entry : kCommands) {
    CLI::App* sub = app.add_subcommand(entry.name, entry.summary);
    commands.emplace_back(sub, entry.declare(*sub));
  }
  try {
    app.parse(argc, argv);
    for (const auto& [sub, run] : commands) {
      if (sub->parsed()) return run();
    }
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kUsage;
  } catch (const std::exception& error) {
    fmt::print(stderr, "umbrix-bench: {}\n", error.what());
    return kFailed;
  }
  return kUsage;
}
