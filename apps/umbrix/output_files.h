// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "render_job.h"
#include "umbrix/status.h"

namespace umbrix::app {

/// Everything about the outputs of all frames that can be known before rendering. output_failed names the file.
Status check_outputs(const RenderArguments& arguments, const std::vector<Frame>& frames);

/// Makes the outputs' missing folders.
Status create_output_folders(const RenderArguments& arguments);

}  // namespace umbrix::app
