// SPDX-License-Identifier: Apache-2.0
#include "error/page_tables.h"

#include <fmt/format.h>

#include "error/figures.h"
#include "error/html.h"
#include "workload/adversarial_rays.h"

namespace umbrix::bench {
namespace {

std::string unfolding(const std::string& summary, const std::string& table) {
  return fmt::format("<details><summary>{}</summary><div class=\"scroll\">{}</div></details>\n", summary, table);
}

/// Calls visit(row, pointer) for the rows of a scene and kind.
template <typename Visit>
void for_rows(const nlohmann::json& report, const std::string& scene, const std::string& kind, const Visit& visit) {
  const nlohmann::json& rows = report.at("rows");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].at("scene") == scene && rows[i].at("kind") == kind) visit(rows[i], fmt::format("/rows/{}", i));
  }
}

std::string ordinary_table(const nlohmann::json& report, const std::string& scene) {
  HtmlTable table(scene + ": ordinary rays", {"tracer", "Mrays/s (quartiles)", "rays", "leaks", "false shadows",
                                              "wrong a million (95 %)", "flux error"});
  for_rows(report, scene, "ordinary", [&](const nlohmann::json& row, const std::string& at) {
    table.start_row(row.at("peer"));
    table.estimate(report, at + "/mrays_per_s");
    for (const char* count : {"/rays", "/leaks", "/false_shadows"}) table.number(report, at + count);
    table.estimate(report, at + "/wrong_per_million");
    if (row.contains("flux_error"))
      table.number(report, at + "/flux_error");
    else
      table.text("");
  });
  return table.html();
}

std::string adversarial_table(const nlohmann::json& report, const std::string& scene) {
  std::vector<std::string> headers = {"tracer", "Mrays/s (quartiles)", "rays", "leaks a million (95 %)",
                                      "false shadows a million (95 %)"};
  for (const workload::Aim aim : workload::kAims) {
    headers.push_back(fmt::format("{}: leaks", workload::aim_name(aim)));
    headers.emplace_back("false");
  }
  HtmlTable table(scene + ": adversarial rays", headers);
  for_rows(report, scene, "adversarial", [&](const nlohmann::json& row, const std::string& at) {
    table.start_row(row.at("peer"));
    table.estimate(report, at + "/mrays_per_s");
    table.number(report, at + "/rays");
    table.estimate(report, at + "/leaks_per_million");
    table.estimate(report, at + "/false_shadows_per_million");
    for (const workload::Aim aim : workload::kAims) {
      const std::string part = fmt::format("{}/aims/{}", at, workload::aim_name(aim));
      table.number(report, part + "/leaks");
      table.number(report, part + "/false_shadows");
    }
  });
  return table.html();
}

std::string error_table(const nlohmann::json& report, const nlohmann::json& images, const std::string& at) {
  std::vector<std::string> headers = {"shadow rays a pixel", "RMSE (quartiles)", "trimmed",
                                      "relMSE (quartiles)",  "trimmed",          "bias (95 %)"};
  const bool has_flip = images.at("points").at(0).contains("flip");
  if (has_flip) headers.insert(headers.end(), {"FLIP (quartiles)", "99th percentile"});
  HtmlTable table(images.at("scene").get<std::string>() + ": error of images", headers);
  for (std::size_t i = 0; i < images.at("points").size(); ++i) {
    const std::string point = fmt::format("{}/points/{}", at, i);
    table.start_row(images.at("points")[i].at("samples").dump());
    for (const char* measure : {"/rmse", "/rmse_trimmed", "/relmse", "/relmse_trimmed", "/bias"})
      table.estimate(report, point + measure);
    if (!has_flip) continue;
    table.estimate(report, point + "/flip");
    table.estimate(report, point + "/flip_99");
  }
  return table.html();
}

std::string time_table(const nlohmann::json& report, const nlohmann::json& images, const std::string& at) {
  std::vector<std::string> headers = {"shadow rays a pixel"};
  const nlohmann::json& points = images.at("points");
  for (const nlohmann::json& time : points.at(0).at("times")) headers.push_back(time.at("kernel"));
  HtmlTable table(images.at("scene").get<std::string>() + ": seconds an image (quartiles)", headers);
  for (std::size_t i = 0; i < points.size(); ++i) {
    table.start_row(points[i].at("samples").dump());
    for (std::size_t k = 0; k < points[i].at("times").size(); ++k)
      table.estimate(report, fmt::format("{}/points/{}/times/{}/seconds", at, i, k));
  }
  return table.html();
}

std::string reference_note(const nlohmann::json& images) {
  const nlohmann::json& reference = images.at("reference");
  const double share = reference.at("noise_share");
  return fmt::format(
      "<p>Images of {0}x{0} pixels, {1} seeds; the light is a {2}. The reference has {3} shadow rays a "
      "pixel and a mean radiance of {4:.3g}; its own noise is estimated at {5:.2g} RMSE, {6:.2f} of the "
      "smallest error shown{7}.</p>\n",
      images.at("size").get<int>(), images.at("seeds").get<int>(), images.at("light").at("type").get<std::string>(),
      reference.at("samples").get<std::uint64_t>(), reference.at("mean").get<double>(),
      reference.at("noise_rmse").get<double>(), share,
      share <= 0.1 ? "" : ", which is more than the tenth that we ask for: read the last points with care");
}

/// The peer of a family that is fastest on ordinary rays; null if there is none.
const nlohmann::json* fastest(const nlohmann::json& report, const std::string& scene, const std::string& family,
                              std::string& pointer) {
  const nlohmann::json* best = nullptr;
  for_rows(report, scene, "ordinary", [&](const nlohmann::json& row, const std::string& at) {
    if (row.at("family") != family) return;
    if (best && row.at("mrays_per_s").at("value") <= best->at("mrays_per_s").at("value")) return;
    best = &row;
    pointer = at;
  });
  return best;
}

}  // namespace

std::string summary_table(const nlohmann::json& report) {
  HtmlTable table("The fastest tracer of each family on ordinary rays, and its errors",
                  {"scene", "family", "tracer", "Mrays/s", "ordinary rays", "wrong a million (95 %)",
                   "adversarial rays", "wrong a million (95 %)"});
  for (const std::string& scene : scenes_of(report)) {
    for (const char* family : {"umbrix", "frame tracer", "embree robust", "embree fast"}) {
      std::string at;
      const nlohmann::json* best = fastest(report, scene, family, at);
      if (!best) continue;
      table.start_row(scene);
      table.text(family);
      table.text(best->at("peer"));
      table.number(report, at + "/mrays_per_s/value");
      table.number(report, at + "/rays");
      table.estimate(report, at + "/wrong_per_million");
      for_rows(report, scene, "adversarial", [&](const nlohmann::json& row, const std::string& hard) {
        if (row.at("peer") != best->at("peer")) return;
        table.number(report, hard + "/rays");
        table.estimate(report, hard + "/wrong_per_million");
      });
    }
  }
  return "<div class=\"scroll\">" + table.html() + "</div>\n";
}

std::vector<std::string> scene_tables(const nlohmann::json& report, const std::string& scene) {
  std::vector<std::string> tables;
  bool has_adversarial = false;
  for_rows(report, scene, "adversarial", [&](const auto&, const auto&) { has_adversarial = true; });
  tables.push_back(unfolding("Table: ordinary rays", ordinary_table(report, scene)));
  if (has_adversarial) tables.push_back(unfolding("Table: adversarial rays", adversarial_table(report, scene)));
  const nlohmann::json& images = report.at("images");
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (images[i].at("scene") != scene) continue;
    const std::string at = fmt::format("/images/{}", i);
    tables.push_back(reference_note(images[i]));
    tables.push_back(unfolding("Table: error of images", error_table(report, images[i], at)));
    tables.push_back(unfolding("Table: seconds an image", time_table(report, images[i], at)));
  }
  return tables;
}

}  // namespace umbrix::bench
