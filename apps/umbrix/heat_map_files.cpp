// SPDX-License-Identifier: Apache-2.0
#include "heat_map_files.h"

#include <fmt/format.h>

#include <algorithm>

#include "image_metadata.h"
#include "output_pattern.h"
#include "strict_number.h"

namespace umbrix::app {
namespace {

constexpr double kLeastHeat = 1e-9, kMostHeat = 1e12;

using render::AovInfo;

HeatMapFile parse_heat_map(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals + 1 == text.size()) {
    throw CLI::ValidationError(fmt::format("--heat-map: '{}' is not of the form AOV=FILE.png", text));
  }
  HeatMapFile map = {{text.substr(0, equals)}, text.substr(equals + 1)};
  std::string names;
  for (const AovInfo& aov : render::known_aovs()) {
    if (!aov.heat_map) continue;
    if (aov.name == map.content.aov) return map;
    names += (names.empty() ? "" : ", ") + aov.name;
  }
  throw CLI::ValidationError(fmt::format("--heat-map: '{}' is not one of {}", map.content.aov, names));
}

/// Takes "AOV=X" to the maps of that AOV, of which there must be one.
void set_heat_max(const std::string& text, std::vector<HeatMapFile>& maps) {
  const std::size_t equals = std::min(text.find('='), text.size());
  const std::string name = text.substr(0, equals);
  double end = 0;
  const bool number = equals < text.size() && parse_number(text.substr(equals + 1), end);
  if (!number || !(end >= kLeastHeat && end <= kMostHeat)) {  // a NaN fails as well
    throw CLI::ValidationError(
        fmt::format("--heat-max: '{}' is not of the form AOV=X with X from {} to {}", text, kLeastHeat, kMostHeat));
  }
  bool drawn = false;
  for (HeatMapFile& map : maps) {
    if (map.content.aov != name) continue;
    if (map.content.end > 0) throw CLI::ValidationError(fmt::format("--heat-max: '{}' is named twice", name));
    map.content.end = end;
    drawn = true;
  }
  if (!drawn) throw CLI::ValidationError(fmt::format("--heat-max: no --heat-map shows '{}'", name));
  for (const AovInfo& aov : render::known_aovs()) {
    if (aov.name == name && !aov.heat_scale) {
      throw CLI::ValidationError(fmt::format("--heat-max: '{}' has no scale", name));
    }
  }
}

/// Heat maps are not photographs: exposure and tone map would falsify their colours.
io::WriteOptions heat_map_options(bool overwrite) {
  io::WriteOptions options;
  options.overwrite = overwrite;
  return options;
}

}  // namespace

void add_heat_map_options(CLI::App& command, RenderArguments& a) {
  const auto add = [&a](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) a.heat_maps.push_back(parse_heat_map(text));
  };
  command
      .add_option_function<std::vector<std::string>>(
          "--heat-map", add, "Draw an AOV in false colours with a legend (and put it into an EXR); may be repeated")
      ->allow_extra_args(false)
      ->type_name("AOV=FILE.png");
  // Called after the above, whatever their order on the command line.
  const auto limit = [&a](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) set_heat_max(text, a.heat_maps);
  };
  command
      .add_option_function<std::vector<std::string>>(
          "--heat-max", limit,
          "Where the AOV's colours end, so that pictures compare; else each picture has its own end; may be repeated")
      ->allow_extra_args(false)
      ->type_name("AOV=X");
}

std::vector<std::string> rendered_aovs(const RenderArguments& a) {
  std::vector<std::string> aovs = a.aovs;
  for (const HeatMapFile& map : a.heat_maps) aovs.push_back(map.content.aov);
  return aovs;
}

std::vector<std::string> heat_map_files(const std::vector<HeatMapFile>& maps) {
  std::vector<std::string> paths;
  for (const HeatMapFile& map : maps) paths.push_back(map.path);
  return paths;
}

Status check_heat_maps(const RenderArguments& a, const Frame& frame) {
  const io::WriteOptions options = heat_map_options(may_exist(a));
  for (const HeatMapFile& map : frame.heat_maps) {
    if (!has_extension(map.path, ".png"))
      return {StatusCode::output_failed, fmt::format("{}: a heat map is a .png", map.path)};
    if (Status status = io::check_output(map.path, options); !status) return status;
  }
  return {};
}

Status write_heat_maps(const RenderJob& job, const Frame& frame, const io::Image& image,
                       const render::RenderStats& stats) {
  for (const HeatMapFile& map : frame.heat_maps) {
    io::Image picture;
    if (Status status = render::make_heat_map(map.content, image, stats, picture); !status) return status;
    picture.metadata = image_metadata(job, frame, map.content);
    const io::WriteOptions options = heat_map_options(job.arguments.write.overwrite);
    if (Status status = io::write_image(map.path, picture, options); !status) return status;
  }
  return {};
}

}  // namespace umbrix::app
