// SPDX-License-Identifier: Apache-2.0
#include "frame_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "heat_map_files.h"
#include "output_pattern.h"

namespace umbrix::app {
namespace {

namespace fs = std::filesystem;

Status check_pattern(const std::string& path, std::size_t frames) {
  const auto wrong = [&](const std::string& reason) {
    return Status(StatusCode::invalid_argument, fmt::format("{}: {}", path, reason));
  };
  const std::size_t places = frame_places(path);
  if (places > 0 && frames == 0) return wrong("has a place for a frame number; --frames tells which");
  if (places > 1) return wrong("has more than one place for the frame number");
  if (places == 0 && frames > 1)
    return wrong("needs a place for the frame number, such as name.####" + fs::path(path).extension().string());
  return {};
}

}  // namespace

Status plan_frames(const RenderArguments& a, std::vector<Frame>& out) {
  out.clear();
  for (const std::vector<std::string>& list : {a.outputs, heat_map_files(a.heat_maps)}) {
    for (const std::string& path : list) {
      if (Status status = check_pattern(path, a.frames.size()); !status) return status;
    }
  }
  if (a.frames.empty()) {
    Frame still;
    still.outputs = a.outputs;
    still.heat_maps = a.heat_maps;
    out.push_back(still);
  }
  for (const int number : a.frames) {
    Frame frame;
    frame.number = number;
    frame.seconds = number / a.fps;
    for (const std::string& path : a.outputs) frame.outputs.push_back(path_of_frame(path, number));
    frame.heat_maps = a.heat_maps;
    for (HeatMapFile& map : frame.heat_maps) map.path = path_of_frame(map.path, number);
    out.push_back(std::move(frame));
  }
  return {};
}

void skip_existing(RenderJob& job) {
  const auto exists = [](const std::string& path) {
    std::error_code error;
    return fs::exists(path, error);
  };
  const auto drawn = [&](const HeatMapFile& map) { return exists(map.path); };
  for (Frame& frame : job.frames) {
    frame.outputs.erase(std::remove_if(frame.outputs.begin(), frame.outputs.end(), exists), frame.outputs.end());
    frame.heat_maps.erase(std::remove_if(frame.heat_maps.begin(), frame.heat_maps.end(), drawn), frame.heat_maps.end());
  }
  const auto done = [](const Frame& frame) { return frame.outputs.empty() && frame.heat_maps.empty(); };
  const auto end = std::remove_if(job.frames.begin(), job.frames.end(), done);
  job.skipped = static_cast<std::size_t>(job.frames.end() - end);
  job.frames.erase(end, job.frames.end());
}

Status place_cameras(RenderJob& job) {
  for (Frame& frame : job.frames) {
    frame.camera = job.view.camera;
    if (!frame.number) continue;
    io::Moment moment;
    moment.frame = *frame.number;
    moment.seconds = frame.seconds;
    if (Status status = io::camera_at(job.view.camera, moment, frame.camera); !status) {
      return {status.code(), fmt::format("{}: frame {}: {}", job.origin.camera_file, *frame.number, status.message())};
    }
  }
  return {};
}

}  // namespace umbrix::app
