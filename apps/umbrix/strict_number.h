// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <string>

namespace umbrix::app {

/// Reads a decimal number that fills the whole text; false for anything else ("0x10", "1e9" for an integer, "nan").
/// Independent of the locale.
bool parse_number(const std::string& text, std::uint64_t& out);
bool parse_number(const std::string& text, double& out);

/// Adds an option for a number within [low, high]; the message for any other text states the range.
CLI::Option* add_integer(CLI::App& app, const std::string& flags, std::uint64_t low, std::uint64_t high,
                         const std::function<void(std::uint64_t)>& set, const std::string& help);
CLI::Option* add_real(CLI::App& app, const std::string& flags, double low, double high,
                      const std::function<void(double)>& set, const std::string& help);

}  // namespace umbrix::app
