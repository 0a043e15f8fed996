// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "render/render.h"
#include "render_arguments.h"
#include "view_choice.h"

namespace umbrix::app {

/// Wall clock time of each phase.
struct PhaseSeconds {
  double load = 0, build = 0, render = 0, write = 0;
};

/// One picture, and the files it goes to.
struct Frame {
  std::optional<int> number;  ///< none: a still
  double seconds = 0;         ///< since frame 0
  io::Camera camera;
  std::vector<std::string> outputs;  ///< images
  std::vector<HeatMapFile> heat_maps;
  std::string checkpoint;  ///< file for its finished tiles
};

/// What became of one frame.
struct FrameReport {
  std::size_t frame = 0;  ///< in RenderJob::frames
  render::RenderStats stats;
  PhaseSeconds seconds;             ///< build, render and write
  std::size_t moved_instances = 0;  ///< since the frame before
  bool tree_built = false;          ///< for this frame, though not for the first
  bool moved_lights = false;
};

/// One run of `umbrix render`, filled from phase to phase.
struct RenderJob {
  explicit RenderJob(const RenderArguments& the_arguments) : arguments(the_arguments) {}

  const RenderArguments& arguments;
  io::SceneFile scene;
  render::View view;                   ///< the camera at rest
  ViewOrigin origin;                   ///< of the view
  std::string inputs_hash;             ///< of scene and setup, see job_hash.h
  std::string pixels_hash;             ///< of all that the frames' floats depend on
  std::vector<Frame> frames;           ///< to render: what is asked for, but what is there already
  std::size_t skipped = 0;             ///< frames that are there already
  Size size;                           ///< of a frame
  std::optional<render::Crop> window;  ///< the part of it to render: crop, pixel or tile
  int threads = 1;
  render::World world;
  std::size_t trees_built = 0;
  FrameTracer tracer;                ///< of shadow rays, unless a kernel was asked for
  std::vector<FrameReport> reports;  ///< kept for --stats only
  render::RenderStats stats;         ///< of all frames
  PhaseSeconds seconds;
};

}  // namespace umbrix::app
