// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render/render.h"
#include "render_arguments.h"

namespace umbrix::app {

/// Wall clock time of each phase.
struct PhaseSeconds {
  double load = 0, build = 0, render = 0, write = 0;
};

/// One run of `umbrix render`, filled from phase to phase.
struct RenderJob {
  explicit RenderJob(const RenderArguments& the_arguments) : arguments(the_arguments) {}

  const RenderArguments& arguments;
  io::SceneFile scene;
  render::View view;
  Size size;  ///< of the frame
  int threads = 1;
  render::World world;
  io::Image image;
  render::RenderStats stats;
  PhaseSeconds seconds;
};

}  // namespace umbrix::app
