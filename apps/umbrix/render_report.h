// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "render_job.h"

namespace umbrix::app {

/// A few aligned lines.
std::vector<std::string> summary(const RenderJob& job);

/// The JSON text of --stats.
std::string stats_text(const RenderJob& job);

}  // namespace umbrix::app
