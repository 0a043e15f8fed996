// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "checkpoints.h"
#include "render_job.h"

namespace umbrix::app {

/// What every frame is rendered with.
render::RenderOptions render_options(const RenderJob& job);

/// Renders the frames one after the other and writes each as soon as it is finished, so that an interruption leaves
/// whole files; what `checkpoints` keeps, too.
Status render_frames(RenderJob& job, Checkpoints& checkpoints);

}  // namespace umbrix::app
