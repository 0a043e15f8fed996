// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render_job.h"

namespace umbrix::app {

using Metadata = std::vector<std::pair<std::string, std::string>>;

/// What a frame's image says of how it was made, without anything that differs between runs, machines or kernels, or
/// with the other frames of the run.
Metadata image_metadata(const RenderJob& job, const Frame& frame, const std::string& path);
Metadata image_metadata(const RenderJob& job, const Frame& frame, const render::HeatMapContent& heat_map);

/// The attribute's value; empty if there is none.
std::string value_of(const Metadata& metadata, const std::string& name);

/// The name of an attribute that only one of the two has, or that has another value; empty if there is none.
std::string first_difference(const Metadata& a, const Metadata& b);

/// Is there an image at `path` that is whole, and says all of this?
bool is_done(const std::string& path, const Metadata& wanted);

}  // namespace umbrix::app
