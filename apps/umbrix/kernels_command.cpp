// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "exit_code.h"
#include "standard_streams.h"
#include "umbrix/kernel.h"

namespace umbrix::app {
namespace {

std::string table() {
  std::string lines;
  for (std::size_t i = 0; i < kernel_count(); ++i) {
    lines += fmt::format("{:16} {}\n", kernel_info(i).name, kernel_info(i).summary);
  }
  lines += "\nSIMD targets, best first:";
  for (std::size_t i = 0; i < simd_target_count(); ++i) lines += fmt::format(" {}", simd_target_name(i));
  return lines + '\n';
}

std::string json_text() {
  nlohmann::ordered_json kernels = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < kernel_count(); ++i) {
    kernels.push_back({{"name", kernel_info(i).name}, {"summary", kernel_info(i).summary}});
  }
  nlohmann::ordered_json targets = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < simd_target_count(); ++i) targets.push_back(simd_target_name(i));
  return nlohmann::ordered_json({{"kernels", kernels}, {"simd_targets", targets}}).dump(2) + '\n';
}

}  // namespace

Command add_kernels_command(CLI::App& program) {
  CLI::App* parser = program.add_subcommand("kernels", "List the ways to walk the tree, and the instruction sets");
  const auto json = std::make_shared<bool>(false);
  parser->add_flag("--json", *json, "For programs");
  return {parser, [json] { return report_status(print_result(*json ? json_text() : table())); }};
}

}  // namespace umbrix::app
