// SPDX-License-Identifier: Apache-2.0
#include "config_file.h"

#include <fmt/format.h>

#include <set>
#include <sstream>

#include "umbrix/io/content_hash.h"

namespace umbrix::app {
namespace {

constexpr std::uint64_t kMostBytes = 1 << 20;

[[noreturn]] void reject(const std::string& path, const std::string& reason) {
  throw CLI::ValidationError(fmt::format("--config: {}: {}", path, reason));
}

std::vector<CLI::ConfigItem> read_items(const std::string& path) {
  std::string text;
  if (Status status = io::read_text(path, kMostBytes, text); !status) {
    throw CLI::ValidationError("--config: " + status.message());
  }
  try {
    std::istringstream stream(text);
    return CLI::ConfigTOML().from_config(stream);
  } catch (const CLI::Error& error) {
    reject(path, error.what());
  }
}

void check_value(const CLI::Option& option, const CLI::ConfigItem& item, const std::string& path) {
  const bool flag = option.get_expected_max() == 0;
  if (flag && (item.inputs.size() != 1 || (item.inputs[0] != "true" && item.inputs[0] != "false"))) {
    reject(path, fmt::format("'{}' is true or false", item.name));
  }
}

CLI::Option& find_option(CLI::App& command, const CLI::ConfigItem& item, const std::string& path) {
  if (!item.parents.empty()) reject(path, fmt::format("sections such as [{}] have no meaning", item.parents.front()));
  CLI::Option* option = command.get_option_no_throw("--" + item.name);
  if (!option) option = command.get_option_no_throw(item.name);
  if (!option || item.name == "config" || item.name == "help") {
    reject(path, fmt::format("'{}' is not an option of 'umbrix {}'", item.name, command.get_name()));
  }
  return *option;
}

/// Gives options the file's values, as if they were on the command line.
void apply(CLI::App& command, const std::string& path) {
  std::set<CLI::Option*> from_file;
  for (const CLI::ConfigItem& item : read_items(path)) {
    CLI::Option& option = find_option(command, item, path);
    check_value(option, item, path);
    if (!option.empty() && from_file.count(&option) == 0) continue;  // on the command line
    if (!from_file.insert(&option).second) reject(path, fmt::format("'{}' is there twice", item.name));
    if (option.get_expected_max() == 0 && item.inputs[0] == "false") continue;
    for (const std::string& input : item.inputs) option.add_result(input);
  }
  // In the order of their definition, as CLI11 does, but here it is known which of them the file is to blame for.
  for (CLI::Option* option : command.get_options()) {
    if (option->empty() || option->get_callback_run() || option->check_name("--config")) continue;
    try {
      option->run_callback();
    } catch (const CLI::Error& error) {
      if (from_file.count(option) == 0) throw;
      reject(path, error.what());
    }
  }
}

}  // namespace

void add_config_option(CLI::App& command) {
  command
      .add_option_function<std::string>(
          "--config", [&command](const std::string& path) { apply(command, path); },
          "Read options from a file of lines 'flag = value'; the command line comes first")
      ->type_name("FILE");
}

}  // namespace umbrix::app
