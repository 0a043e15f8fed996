// SPDX-License-Identifier: Apache-2.0
#include "error/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "error/html.h"
#include "error/page_tables.h"
#include "error/page_text.h"
#include "plot/svg.h"

namespace umbrix::bench {
namespace {

constexpr const char* kTitle = "Umbrix: run time against error";

std::string anchor_of(const std::string& scene) {
  std::string anchor = "scene-" + scene;
  std::replace(anchor.begin(), anchor.end(), ' ', '-');
  return anchor;
}

/// A chart within the page: without the XML declaration, which belongs to files, and with words for screen readers.
std::string inline_figure(const Figure& figure) {
  const std::size_t start = figure.svg.find("<svg ");
  return fmt::format("<figure><svg role=\"img\" aria-label=\"{}\" {}<figcaption>{}</figcaption></figure>\n",
                     plot::xml_text(figure.description), figure.svg.substr(start + 5), plot::xml_text(figure.title));
}

std::string lead(const nlohmann::json& report) {
  std::uint64_t rays = 0, answers = 0, wrong = 0;
  std::set<std::string> tracers;
  for (const nlohmann::json& row : report.at("rows")) {
    const std::string family = row.at("family");
    if (row.at("scene") == "all scenes" || family.rfind("embree", 0) == 0) continue;
    if (row.at("peer") == "umbrix:standard") rays += row.at("rays").get<std::uint64_t>();
    tracers.insert(row.at("peer"));
    answers += row.at("rays").get<std::uint64_t>();
    wrong += row.at("leaks").get<std::uint64_t>() + row.at("false_shadows").get<std::uint64_t>();
  }
  return fmt::format(
      "<p class=\"lead\">{} kernels and frame tracers of Umbrix answered {} shadow rays: {} answers, {} of them wrong. "
      "Below: wrong answers and image error, each against time, with Embree {} on the same rays.</p>\n",
      tracers.size(), rays, answers, wrong, plot::xml_text(report.at("machine").at("embree").get<std::string>()));
}

std::string load_text(const nlohmann::json& load) {
  return load.is_array() ? fmt::format("{:.1f}", load[0].get<double>()) : "unknown";
}

std::string setup_section(const nlohmann::json& report) {
  const nlohmann::json& machine = report.at("machine");
  HtmlTable table("Machine and versions", {"", ""});
  const auto add = [&table](const char* name, const nlohmann::json& value) {
    table.start_row(name);
    table.text(value.is_string() ? value.get<std::string>() : value.dump());
  };
  add("processor", machine.at("processor"));
  add("cores", machine.at("cores"));
  add("instruction set used", machine.at("simd_target"));
  add("system", machine.at("system"));
  add("compiler", machine.at("compiler"));
  add("Umbrix", machine.at("umbrix"));
  add("Embree", machine.at("embree"));
  add("date", machine.at("date"));
  add("load of the machine, before and after",
      load_text(report.at("load_before")) + ", " + load_text(report.at("load_after")));
  std::string html = "<section id=\"setup\"><h2>Machine</h2>\n<div class=\"scroll\">" + table.html() + "</div>\n";
  if (report.at("load_before").is_array() && report.at("load_before")[0].get<double>() > 0.5) {
    html +=
        "<p>Other work ran on the machine at the time. Errors do not depend on it. Trust ratios of speeds more than "
        "speeds: rounds are interleaved, and times are processor time of one thread.</p>\n";
  }
  return html + "</section>\n";
}

std::string scene_section(const nlohmann::json& report, const std::vector<Figure>& figures, const std::string& scene) {
  std::string html =
      fmt::format("<section id=\"{}\"><h2>{}</h2>\n", plot::xml_text(anchor_of(scene)), plot::xml_text(scene));
  std::string pair;
  for (const Figure& figure : figures) {
    if (figure.scene != scene) continue;
    const bool is_image = figure.name.find("mse") != std::string::npos;
    (is_image ? pair : html) += inline_figure(figure);
  }
  if (!pair.empty()) html += "<div class=\"pair\">" + pair + "</div>\n";
  for (const std::string& table : scene_tables(report, scene)) html += table;
  return html + "</section>\n";
}

}  // namespace

std::string page_of(const nlohmann::json& report, const std::vector<Figure>& figures) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<link rel=\"icon\" href=\"data:,\">\n<title>{0}</title>\n<style>{1}</style>\n</head>\n<body>\n<h1>{0}</h1>\n",
      kTitle, kPageStyle);
  html += lead(report) + "<nav aria-label=\"Contents\"><a href=\"#summary\">Summary</a>";
  for (const std::string& scene : scenes_of(report))
    html += fmt::format("<a href=\"#{}\">{}</a>", plot::xml_text(anchor_of(scene)), plot::xml_text(scene));
  html += "<a href=\"#methods\">Methods</a><a href=\"#setup\">Machine</a></nav>\n";
  html += "<main>\n<section id=\"summary\"><h2>Summary</h2>\n" + summary_table(report) + "</section>\n";
  for (const std::string& scene : scenes_of(report)) html += scene_section(report, figures, scene);
  html += fmt::format("<section id=\"methods\"><h2>Methods</h2>{}</section>\n", kMethods) + setup_section(report);
  html +=
      fmt::format("<p><a download=\"error.json\" href=\"{}\">All numbers as JSON</a></p>\n</main>\n</body>\n</html>\n",
                  data_uri(report));
  return html;
}

}  // namespace umbrix::bench
