// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "render/render.h"
#include "render_arguments.h"
#include "umbrix/stats.h"

namespace umbrix::app {

/// What `umbrix render` did, for people and for programs.
struct RenderReport {
  const RenderArguments& arguments;
  const io::SceneFile& scene;
  const render::World& world;
  const render::View& view;
  const render::RenderStats& stats;
  int width = 0, height = 0;  ///< of the frame
  int threads = 1;
  double seconds_load = 0, seconds_build = 0, seconds_render = 0, seconds_write = 0;
};

/// A few aligned lines.
std::vector<std::string> summary(const RenderReport& report);

/// The JSON text of --stats.
std::string stats_text(const RenderReport& report);

}  // namespace umbrix::app
