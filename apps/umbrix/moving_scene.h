// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render_job.h"

namespace umbrix::app {

/// Moves the scene, its lights among the view's, to where they are in a frame; a still stays at rest. Fails as
/// io::pose_scene, naming file and frame.
Status pose_scene(RenderJob& job, const Frame& frame, io::SceneChanges& changes);

/// Builds the world of the scene as it is, and starts the tracer.
Status build_world(RenderJob& job);

/// The same again for what has moved; what stays in a frame is not built anew. Says in the report what was done.
Status move_world(RenderJob& job, const Frame& frame, FrameReport& report);

}  // namespace umbrix::app
