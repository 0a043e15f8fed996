// SPDX-License-Identifier: Apache-2.0
#include "light_choice.h"

#include <fmt/format.h>

#include <numeric>

namespace umbrix::bench {

CLI::Validator light_validator() {
  return CLI::Validator(
      [](const std::string& text) {
        const bool number =
            !text.empty() && text.size() < 10 && text.find_first_not_of("0123456789") == std::string::npos;
        return number || text == "all" ? std::string() : "'" + text + "' is neither a number nor 'all'";
      },
      "N|all");
}

Status choose_lights(const std::string& text, std::size_t count, const std::string& path,
                     std::vector<std::size_t>& out) {
  if (text == "all") {
    out.resize(count);
    std::iota(out.begin(), out.end(), std::size_t{0});
    return {};
  }
  out = {std::stoull(text)};
  if (out[0] < count) return {};
  return {StatusCode::invalid_argument, fmt::format("{}: no light {}; there are {}", path, text, count)};
}

}  // namespace umbrix::bench
