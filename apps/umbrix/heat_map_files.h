// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render_arguments.h"
#include "render_job.h"

namespace umbrix::app {

/// Adds --heat-map, which fills `arguments.heat_maps` with known AOVs, and --heat-max.
void add_heat_map_options(CLI::App& command, RenderArguments& arguments);

/// The AOVs to render: those asked for and, after them, those that heat maps show.
std::vector<std::string> rendered_aovs(const RenderArguments& arguments);

/// Their paths, or patterns of paths.
std::vector<std::string> heat_map_files(const std::vector<HeatMapFile>& maps);

/// Fails as write_heat_maps would, for what can be known before rendering.
Status check_heat_maps(const RenderArguments& arguments, const Frame& frame);

/// Draws and writes those of a frame from its image and stats. output_failed names the file.
Status write_heat_maps(const RenderJob& job, const Frame& frame, const io::Image& image,
                       const render::RenderStats& stats);

}  // namespace umbrix::app
