// SPDX-License-Identifier: Apache-2.0
#include "frame_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "heat_map_files.h"
#include "image_metadata.h"
#include "message.h"
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

/// A tile has files of its own.
void name_parts(const RenderArguments& a, Frame& frame) {
  if (a.tile) {
    for (std::string& path : frame.outputs) path = path_of_tile(path, *a.tile);
  }
  if (!frame.outputs.empty()) frame.checkpoint = frame.outputs.front() + ".part";
  if (frame.outputs.empty() && !frame.heat_maps.empty()) frame.checkpoint = frame.heat_maps.front().path + ".part";
}

/// Takes away files for which `done` is true, and frames that have no other.
template <class ImageDone, class HeatMapDone>
void leave_out(RenderJob& job, ImageDone image_done, HeatMapDone heat_map_done) {
  for (Frame& frame : job.frames) {
    const auto image = [&](const std::string& path) { return image_done(frame, path); };
    const auto heat_map = [&](const HeatMapFile& map) { return heat_map_done(frame, map); };
    frame.outputs.erase(std::remove_if(frame.outputs.begin(), frame.outputs.end(), image), frame.outputs.end());
    frame.heat_maps.erase(std::remove_if(frame.heat_maps.begin(), frame.heat_maps.end(), heat_map),
                          frame.heat_maps.end());
  }
  const auto done = [](const Frame& frame) { return frame.outputs.empty() && frame.heat_maps.empty(); };
  const auto end = std::remove_if(job.frames.begin(), job.frames.end(), done);
  job.skipped = static_cast<std::size_t>(job.frames.end() - end);
  job.frames.erase(end, job.frames.end());
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
  for (Frame& frame : out) name_parts(a, frame);
  return {};
}

void skip_existing(RenderJob& job) {
  const auto exists = [](const std::string& path) {
    std::error_code error;
    return fs::exists(path, error);
  };
  leave_out(
      job, [&](const Frame&, const std::string& path) { return exists(path); },
      [&](const Frame&, const HeatMapFile& map) { return exists(map.path); });
}

void skip_done(RenderJob& job) {
  const auto done = [&](const Frame& frame, const std::string& path, const Metadata& metadata) {
    if (!is_done(path, metadata)) return false;
    if (!job.arguments.quiet) say(fmt::format("umbrix: skip {}, it is done", path));
    // Whoever wrote it was killed before it could do this.
    std::error_code error;
    fs::remove(frame.checkpoint, error);
    return true;
  };
  leave_out(
      job,
      [&](const Frame& frame, const std::string& path) { return done(frame, path, image_metadata(job, frame, path)); },
      [&](const Frame& frame, const HeatMapFile& map) {
        return done(frame, map.path, image_metadata(job, frame, map.content));
      });
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
