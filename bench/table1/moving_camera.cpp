// SPDX-License-Identifier: Apache-2.0
#include "table1/moving_camera.h"

#include <cmath>

namespace umbrix::bench {
Frames moving_camera_frames(const Scene& scene, const workload::Geometry& geometry, const io::Camera& camera,
                            const io::Light& light, int size, const CameraMotion& motion) {
  Frames frames;
  for (int i = 0; i < motion.frames; ++i) {
    io::Camera moved = camera;
    const double step = motion.step * workload::diagonal(scene) * (motion.frames - 1 - i);
    for (auto& row : moved.to_world) row[3] -= step * row[0];
    frames.push_back(workload::tiled_shadow_rays(scene, geometry, moved, light, size));
  }
  return frames;
}

}  // namespace umbrix::bench
