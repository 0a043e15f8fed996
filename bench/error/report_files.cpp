// SPDX-License-Identifier: Apache-2.0
#include "error/report_files.h"

#include <fmt/core.h>

#include <filesystem>
#include <fstream>
#include <vector>

#include "error/figures.h"
#include "error/page.h"
#include "plot/png.h"
#include "umbrix/io/image_file.h"

namespace umbrix::bench {
namespace {

constexpr double kPngScale = 1.5;

Status write_folder(const std::string& folder, const std::vector<Figure>& figures, const std::string& page) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return {StatusCode::output_failed, fmt::format("{}: {}", folder, error.message())};
  for (const Figure& figure : figures) {
    const std::string path = fmt::format("{}/{}", folder, figure.name);
    if (Status status = io::write_text(path + ".svg", figure.svg, true); !status) return status;
    if (!plot::can_rasterise()) continue;
    if (Status status = plot::write_png(path + ".png", figure.svg, kPngScale); !status) return status;
  }
  if (!plot::can_rasterise())
    fmt::print(stderr, "umbrix-bench: {}: no PNG, since librsvg was not there when this was built\n", folder);
  return io::write_text(folder + "/index.html", page, true);
}

}  // namespace

Status write_report(const nlohmann::json& report, const ReportFiles& files) {
  if (!files.json.empty()) {
    if (Status status = io::write_text(files.json, report.dump(1) + "\n", true); !status) return status;
  }
  if (files.html.empty() && files.folder.empty()) return {};
  const std::vector<Figure> figures = draw_figures(report);
  const std::string page = page_of(report, figures);
  if (!files.html.empty()) {
    if (Status status = io::write_text(files.html, page, true); !status) return status;
  }
  return files.folder.empty() ? Status() : write_folder(files.folder, figures, page);
}

Status read_report(const std::string& path, nlohmann::json& out) {
  std::ifstream file(path);
  if (!file) return {StatusCode::bad_input, fmt::format("{}: cannot be read", path)};
  out = nlohmann::json::parse(file, nullptr, false);
  if (out.is_object() && out.contains("rows") && out.contains("images") && out.contains("machine")) return {};
  return {StatusCode::bad_input, fmt::format("{}: is not a report of umbrix-bench error", path)};
}

}  // namespace umbrix::bench
