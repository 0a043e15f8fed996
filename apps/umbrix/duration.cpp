// SPDX-License-Identifier: Apache-2.0
#include "duration.h"

#include <fmt/format.h>

#include "strict_number.h"

namespace umbrix::app {
namespace {

constexpr double kLeast = 1, kMost = 366 * 24 * 3600.0;

/// Of a unit, in seconds; 0 if there is none of that name.
double unit_of(char name) { return name == 's' ? 1 : name == 'm' ? 60 : name == 'h' ? 3600 : 0; }

}  // namespace

CLI::Option* add_duration(CLI::App& app, const std::string& flag, const std::function<void(double)>& set,
                          const std::string& help) {
  const auto read = [=](const std::string& text) {
    const double unit = text.empty() ? 0 : unit_of(text.back());
    double number = 0;
    const bool parsed = parse_number(unit > 0 ? text.substr(0, text.size() - 1) : text, number);
    const double seconds = number * (unit > 0 ? unit : 1);
    if (!parsed || !(seconds >= kLeast && seconds <= kMost)) {  // a NaN fails as well
      throw CLI::ValidationError(
          fmt::format("{}: '{}' is not a time of the form 90s, 5m or 1.5h from 1s on", flag, text));
    }
    set(seconds);
  };
  return app.add_option_function<std::string>(flag, read, help)->type_name("TIME");
}

}  // namespace umbrix::app
