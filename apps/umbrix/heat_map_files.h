// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render_arguments.h"
#include "render_job.h"

namespace umbrix::app {

/// Adds --heat-map, which fills `arguments.heat_maps` with known AOVs.
void add_heat_map_option(CLI::App& command, RenderArguments& arguments);

/// The AOVs to render: those asked for and, after them, those that heat maps show.
std::vector<std::string> rendered_aovs(const RenderArguments& arguments);

/// The files of --heat-map.
std::vector<std::string> heat_map_files(const RenderArguments& arguments);

/// Fails as write_heat_maps would, for what can be known before rendering.
Status check_heat_maps(const RenderArguments& arguments);

/// Draws and writes them, one after another. output_failed names the file.
Status write_heat_maps(const RenderJob& job);

}  // namespace umbrix::app
