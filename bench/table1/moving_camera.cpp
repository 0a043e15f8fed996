// SPDX-License-Identifier: Apache-2.0
#include "table1/moving_camera.h"

#include <cmath>

namespace umbrix::bench {
namespace {

double diagonal(const Scene& scene) {
  float lower[3], upper[3];
  if (!scene.bounds(lower, upper)) return 0;
  return std::hypot(double{upper[0]} - lower[0], double{upper[1]} - lower[1], double{upper[2]} - lower[2]);
}

}  // namespace

Frames moving_camera_frames(const Scene& scene, const workload::Geometry& geometry, const io::Camera& camera,
                            const io::Light& light, int size, const CameraMotion& motion) {
  Frames frames;
  for (int i = 0; i < motion.frames; ++i) {
    io::Camera moved = camera;
    const double step = motion.step * diagonal(scene) * (motion.frames - 1 - i);
    for (auto& row : moved.to_world) row[3] -= step * row[0];
    frames.push_back(workload::tiled_shadow_rays(scene, geometry, moved, light, size));
  }
  return frames;
}

}  // namespace umbrix::bench
