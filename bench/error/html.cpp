// SPDX-License-Identifier: Apache-2.0
#include "error/html.h"

#include <fmt/format.h>

#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <cmath>

#include "plot/svg.h"

namespace umbrix::bench {
namespace {

std::string sourced(const char* element, const std::string& pointer, const nlohmann::json& value) {
  return fmt::format("<{0} data-source=\"{1}\">{2}</{0}>", element, plot::xml_text(pointer), number_text(value));
}

}  // namespace

HtmlTable::HtmlTable(std::string caption, const std::vector<std::string>& headers) {
  head_ = fmt::format("<table>\n<caption>{}</caption>\n<thead><tr>", plot::xml_text(caption));
  for (const std::string& header : headers) head_ += fmt::format("<th scope=\"col\">{}</th>", plot::xml_text(header));
  head_ += "</tr></thead>\n<tbody>\n";
}

void HtmlTable::start_row(const std::string& name) {
  if (!body_.empty()) body_ += "</tr>\n";
  body_ += fmt::format("<tr><th scope=\"row\">{}</th>", plot::xml_text(name));
}

void HtmlTable::text(const std::string& text) {
  body_ += fmt::format("<td class=\"text\">{}</td>", plot::xml_text(text));
}

void HtmlTable::number(const nlohmann::json& report, const std::string& pointer) {
  body_ += sourced("td", pointer, report.at(nlohmann::json::json_pointer(pointer)));
}

void HtmlTable::estimate(const nlohmann::json& report, const std::string& pointer) {
  const nlohmann::json& estimate = report.at(nlohmann::json::json_pointer(pointer));
  body_ += "<td>" + sourced("b", pointer + "/value", estimate.at("value")) + " <span>" +
           sourced("i", pointer + "/low", estimate.at("low")) + " to " +
           sourced("i", pointer + "/high", estimate.at("high")) + "</span></td>";
}

std::string HtmlTable::html() const {
  return head_ + body_ + (body_.empty() ? "" : "</tr>\n") + "</tbody>\n</table>\n";
}

std::string number_text(const nlohmann::json& value) {
  if (value.is_number_integer()) return value.dump();
  if (!value.is_number()) return "unknown";  // JSON has no infinity
  const double x = value.get<double>();
  if (std::abs(x) >= 1000) return fmt::format("{:.0f}", x);
  return fmt::format("{:.3g}", x);
}

std::string data_uri(const nlohmann::json& report) {
  namespace iterators = boost::archive::iterators;
  using Base64 = iterators::base64_from_binary<iterators::transform_width<std::string::const_iterator, 6, 8>>;
  std::string bytes = report.dump();
  bytes.resize((bytes.size() + 2) / 3 * 3, ' ');  // white space means nothing to JSON, and spares base64's padding
  return "data:application/json;base64," + std::string(Base64(bytes.begin()), Base64(bytes.end()));
}

}  // namespace umbrix::bench
