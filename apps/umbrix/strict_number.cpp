// SPDX-License-Identifier: Apache-2.0
#include "strict_number.h"

#include <fmt/format.h>

#include <charconv>

namespace umbrix::app {
namespace {

template <typename T>
bool parse_all(const std::string& text, T& out) {
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, out);
  return error == std::errc() && stop == end;
}

template <typename T>
CLI::Option* add_number(CLI::App& app, const std::string& flags, T low, T high, const std::function<void(T)>& set,
                        const std::string& help, const char* type) {
  const auto read = [=](const std::string& text) {
    T value;
    // Written so that a NaN fails as well.
    if (!parse_number(text, value) || !(value >= low && value <= high)) {
      throw CLI::ValidationError(fmt::format("{}: '{}' is not a number from {} to {}", flags, text, low, high));
    }
    set(value);
  };
  return app.add_option_function<std::string>(flags, read, help)->type_name(type);
}

}  // namespace

bool parse_number(const std::string& text, std::uint64_t& out) { return parse_all(text, out); }

bool parse_number(const std::string& text, double& out) { return parse_all(text, out); }

CLI::Option* add_integer(CLI::App& app, const std::string& flags, std::uint64_t low, std::uint64_t high,
                         const std::function<void(std::uint64_t)>& set, const std::string& help) {
  return add_number<std::uint64_t>(app, flags, low, high, set, help, "N");
}

CLI::Option* add_real(CLI::App& app, const std::string& flags, double low, double high,
                      const std::function<void(double)>& set, const std::string& help) {
  return add_number<double>(app, flags, low, high, set, help, "X");
}

}  // namespace umbrix::app
