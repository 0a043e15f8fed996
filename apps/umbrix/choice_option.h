// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <functional>
#include <map>
#include <string>

namespace umbrix::app {

/// Adds an option whose value is one of a few words; `set` is given what the word means.
template <typename T>
void add_choice(CLI::App& command, const std::string& flags, const std::function<void(T)>& set,
                const std::map<std::string, T>& words, const std::string& help) {
  std::string names;
  for (const auto& [word, meaning] : words) names += (names.empty() ? "" : "|") + word;
  const auto choose = [set, words, flags, names](const std::string& word) {
    const auto found = words.find(word);
    if (found == words.end()) {
      throw CLI::ValidationError(fmt::format("{}: '{}' is not one of {}", flags, word, names));
    }
    set(found->second);
  };
  command.add_option_function<std::string>(flags, choose, help)->type_name(names);
}

}  // namespace umbrix::app
