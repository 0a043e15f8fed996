// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render_arguments.h"
#include "umbrix/status.h"

namespace umbrix::app {

/// Everything about the outputs that can be known before rendering. output_failed names the file.
Status check_outputs(const RenderArguments& arguments);

/// Makes the outputs' missing folders.
Status create_output_folders(const RenderArguments& arguments);

}  // namespace umbrix::app
