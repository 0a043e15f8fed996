// SPDX-License-Identifier: Apache-2.0
#include "output_files.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "heat_map_files.h"
#include "output_pattern.h"

namespace umbrix::app {
namespace {

namespace fs = std::filesystem;

Status failed(const std::string& path, const std::string& reason) {
  return {StatusCode::output_failed, fmt::format("{}: {}", path, reason)};
}

fs::path folder_of(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  return folder.empty() ? "." : folder;
}

Status check_stats_file(const RenderArguments& a) {
  std::error_code error;
  if (fs::is_directory(a.stats, error)) return failed(a.stats, "is a folder");
  if (fs::exists(a.stats, error) && !may_exist(a)) return failed(a.stats, "exists (use --overwrite to replace it)");
  if (!fs::is_directory(folder_of(a.stats), error)) return failed(a.stats, "its folder does not exist");
  if (access(folder_of(a.stats).c_str(), W_OK) != 0) return failed(a.stats, "its folder cannot be written to");
  return {};
}

std::vector<std::string> report_files(const RenderArguments& a) {
  if (a.stats.empty() || a.stats == "-") return {};
  return {a.stats};
}

/// Refuses a file that is named twice, by whatever pattern, or is an input.
Status check_names(const RenderArguments& a, const std::vector<std::string>& paths, std::set<std::string>& seen) {
  std::error_code error;
  for (const std::string& path : paths) {
    if (!seen.insert(fs::absolute(path, error).lexically_normal().string()).second) {
      return {StatusCode::invalid_argument, fmt::format("{}: named twice as an output", path)};
    }
    for (const std::string& input : {a.scene, a.setup}) {
      if (fs::equivalent(path, input, error)) return failed(path, "is an input of this command");
    }
  }
  return {};
}

}  // namespace

Status check_outputs(const RenderArguments& a, const std::vector<Frame>& frames) {
  std::set<std::string> seen;
  if (Status status = check_names(a, report_files(a), seen); !status) return status;
  for (const Frame& frame : frames) {
    for (const std::vector<std::string>& list : {frame.outputs, heat_map_files(frame.heat_maps)}) {
      if (Status status = check_names(a, list, seen); !status) return status;
    }
  }
  if (!a.preview.empty()) {
    if (Status status = check_names(a, {a.preview}, seen); !status) return status;
    io::WriteOptions options = a.write;
    options.overwrite = true;
    if (Status status = io::check_output(a.preview, options); !status) return status;
  }
  const auto is_exr = [](const std::string& path) { return has_extension(path, ".exr"); };
  if (!a.aovs.empty() && !a.print_pixel && std::none_of(a.outputs.begin(), a.outputs.end(), is_exr)) {
    return {StatusCode::invalid_argument, "--aov needs an .exr output; other formats hold colour only"};
  }
  io::WriteOptions options = a.write;
  options.overwrite = may_exist(a);
  for (const Frame& frame : frames) {
    for (const std::string& path : frame.outputs) {
      if (Status status = io::check_output(path, options); !status) return status;
    }
    if (Status status = check_heat_maps(a, frame); !status) return status;
  }
  return report_files(a).empty() ? Status() : check_stats_file(a);
}

Status create_output_folders(const RenderArguments& a) {
  for (const std::vector<std::string>& list : {a.outputs, heat_map_files(a.heat_maps), report_files(a)}) {
    for (const std::string& path : list) {
      std::error_code error;
      fs::create_directories(folder_of(path), error);
      if (error) return failed(path, fmt::format("cannot make its folder: {}", error.message()));
    }
  }
  return {};
}

}  // namespace umbrix::app
