// SPDX-License-Identifier: Apache-2.0
#include "error/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "plot/line_chart.h"
#include "plot/scatter_chart.h"

namespace umbrix::bench {
namespace {

/// The peers' families, in the order of their colours.
constexpr std::array<std::pair<const char*, const char*>, 4> kFamilies = {{{"umbrix", "Umbrix kernels"},
                                                                           {"embree fast", "Embree fast"},
                                                                           {"frame tracer", "Umbrix frame tracers"},
                                                                           {"embree robust", "Embree robust"}}};

/// What a peer is called in a chart, where the colour says its family.
std::string short_name(const std::string& peer) {
  std::string name = peer.substr(peer.find(':') + 1);
  name = name.substr(0, name.find(':'));
  for (const auto& [from, to] : {std::pair<std::string, std::string>{"incoherent", "inc."}, {"coherent", "coh."}}) {
    if (const std::size_t at = name.find(from); at != std::string::npos) name.replace(at, from.size(), to);
  }
  return name;
}

plot::ScatterPoint point_of(const nlohmann::json& row, const char* rate) {
  const nlohmann::json& y = row.at(rate);
  return {row.at("mrays_per_s").at("value"), y.at("value"), y.at("low"), y.at("high"), ""};
}

/// Names are given to the fastest first, so that these have one where room is scarce.
void name_points(std::vector<std::pair<plot::ScatterPoint, std::string>> named, plot::ScatterSeries& series) {
  std::stable_sort(named.begin(), named.end(), [](const auto& a, const auto& b) { return a.first.x > b.first.x; });
  for (auto& [point, name] : named) {
    point.label = name;
    series.points.push_back(point);
  }
}

std::string rays_title(const std::string& scene, const std::string& kind) {
  return fmt::format("{}: {} rays", scene, kind);
}

Figure ray_figure(const nlohmann::json& rows, const std::string& scene, const std::string& kind) {
  plot::ScatterChart chart;
  chart.title = rays_title(scene, kind);
  chart.x = {"millions of rays a second, one thread", true, {}, {}};
  chart.y = {"wrong a million rays", true, {}, {}};
  double bound = 0;
  bool is_any_wrong = false;
  std::uint64_t rays = 0;
  std::string described;
  for (std::size_t style = 0; style < kFamilies.size(); ++style) {
    plot::ScatterSeries leaks{kFamilies[style].second, style}, false_shadows{"", style, true};
    std::vector<std::pair<plot::ScatterPoint, std::string>> named;
    double least = 0, most = 0;
    for (const nlohmann::json& row : rows) {
      if (row.at("scene") != scene || row.at("kind") != kind || row.at("family") != kFamilies[style].first) continue;
      named.emplace_back(point_of(row, "leaks_per_million"), short_name(row.at("peer")));
      false_shadows.points.push_back(point_of(row, "false_shadows_per_million"));
      const double wrong = row.at("wrong_per_million").at("value");
      least = named.size() == 1 ? wrong : std::min(least, wrong);
      most = std::max(most, wrong);
      rays = row.at("rays");
      for (const char* rate : {"leaks_per_million", "false_shadows_per_million"}) {
        if (row.at(rate).at("value") == 0.0)
          bound = row.at(rate).at("high");
        else
          is_any_wrong = true;
      }
    }
    if (named.empty()) continue;
    described += fmt::format(" {}: {:.4g} to {:.4g} wrong a million.", kFamilies[style].second, least, most);
    name_points(std::move(named), leaks);
    chart.series.push_back(std::move(leaks));
    chart.series.push_back(std::move(false_shadows));
  }
  constexpr std::size_t kBlack = 6;
  chart.series.push_back({"filled: leaks, ring: false shadows", kBlack, true});
  if (!is_any_wrong) chart.height = 400;
  if (bound > 0) {
    chart.zero_bound = bound;
    chart.zero_note = fmt::format("95 % upper bound where none of {} rays was wrong: {:.2g} a million", rays, bound);
  }
  std::string file = fmt::format("{}-{}", scene, kind);
  std::replace(file.begin(), file.end(), ' ', '-');
  return {std::move(file), scene, chart.title,
          fmt::format("Scatter chart, rates of wrong answers over rays a second, {}.{}", chart.title, described),
          plot::svg_text(chart)};
}

Figure image_figure(const nlohmann::json& images, const char* measure, const std::string& axis) {
  plot::LineChart chart;
  const std::string scene = images.at("scene");
  chart.title = fmt::format("{}: {} over time", scene, axis);
  chart.x = {"seconds an image, one thread", true, {}, {}};
  chart.y = {axis, true, {}, {}};
  chart.width = 640;
  chart.height = 440;
  for (const nlohmann::json& point : images.at("points")) {
    const nlohmann::json& error = point.at(measure);
    for (std::size_t i = 0; i < point.at("times").size(); ++i) {
      const nlohmann::json& time = point.at("times")[i];
      if (chart.series.size() <= i) chart.series.push_back({time.at("kernel"), {}});
      chart.series[i].points.push_back({time.at("seconds").at("value"), error.at("value")});
      chart.series[i].band.push_back({error.at("low").get<double>(), error.at("high").get<double>()});
    }
  }
  const nlohmann::json& last = images.at("points").back();
  return {fmt::format("{}-{}", scene, measure), scene, chart.title,
          fmt::format("Line chart, {} over seconds for 1 to {} shadow rays a pixel, a line for each kernel. With most "
                      "rays the error is {:.3g}.",
                      axis, last.at("samples").get<int>(), last.at(measure).at("value").get<double>()),
          plot::svg_text(chart)};
}

}  // namespace

std::vector<std::string> scenes_of(const nlohmann::json& report) {
  std::vector<std::string> scenes;
  const auto add = [&scenes](const std::string& scene) {
    if (std::find(scenes.begin(), scenes.end(), scene) == scenes.end()) scenes.push_back(scene);
  };
  for (const nlohmann::json& row : report.at("rows")) add(row.at("scene"));
  for (const nlohmann::json& images : report.at("images")) add(images.at("scene"));
  return scenes;
}

std::vector<Figure> draw_figures(const nlohmann::json& report) {
  std::vector<Figure> figures;
  for (const std::string& scene : scenes_of(report)) {
    for (const char* kind : {"ordinary", "adversarial"}) {
      const bool has_rows = std::any_of(report.at("rows").begin(), report.at("rows").end(), [&](const auto& row) {
        return row.at("scene") == scene && row.at("kind") == kind;
      });
      if (has_rows) figures.push_back(ray_figure(report.at("rows"), scene, kind));
    }
    for (const nlohmann::json& images : report.at("images")) {
      if (images.at("scene") != scene) continue;
      figures.push_back(image_figure(images, "rmse", "RMSE"));
      figures.push_back(image_figure(images, "relmse", "relMSE"));
    }
  }
  return figures;
}

}  // namespace umbrix::bench
