// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace umbrix::bench {

/// A table of a page. Its numbers say where in the report they come from (`data-source`, a JSON pointer).
class HtmlTable {
 public:
  HtmlTable(std::string caption, const std::vector<std::string>& headers);

  void start_row(const std::string& name);
  void text(const std::string& text);
  void number(const nlohmann::json& report, const std::string& pointer);
  /// value, and beneath it low to high.
  void estimate(const nlohmann::json& report, const std::string& pointer);

  std::string html() const;

 private:
  std::string head_, body_;
};

/// Rounded to three digits, counts in full, as a table shows it.
std::string number_text(const nlohmann::json& value);

/// The report as the address of a link.
std::string data_uri(const nlohmann::json& report);

}  // namespace umbrix::bench
