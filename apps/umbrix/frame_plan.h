// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "render_job.h"

namespace umbrix::app {

/// The frames that are asked for, with their numbers, times and files. invalid_argument if a file's name does not tell
/// frames apart, or has a place for a number where none is asked for.
Status plan_frames(const RenderArguments& arguments, std::vector<Frame>& out);

/// Takes away what is there already: files, and frames that have all of theirs.
void skip_existing(RenderJob& job);

/// Takes away what is done already: files that are whole and of this job, and frames that have all of theirs. Says so.
void skip_done(RenderJob& job);

/// Gives each frame its camera: a still the one at rest. Fails as io::camera_at, naming file and frame.
Status place_cameras(RenderJob& job);

}  // namespace umbrix::app
