// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "table1/contestant.h"
#include "workload/geometry.h"
#include "workload/shadow_rays.h"

namespace umbrix::bench {

/// How many frames a camera takes, and how far it goes between two, in scene diagonals.
struct CameraMotion {
  int frames = 2;
  double step = 0.01;
};

/// The light's shadow rays in each frame of a camera that moves along its right axis and ends at the viewpoint; size x
/// size primary rays each. `scene` holds `geometry`.
Frames moving_camera_frames(const Scene& scene, const workload::Geometry& geometry, const io::Camera& camera,
                            const io::Light& light, int size, const CameraMotion& motion);

}  // namespace umbrix::bench
