// SPDX-License-Identifier: Apache-2.0
#include "io/camera_motion.h"

#include <new>

#include "io/load_error.h"

namespace umbrix::io {

CameraMotion::~CameraMotion() = default;

Status camera_at(const Camera& camera, const Moment& moment, Camera& out) try {
  Camera moved = camera;
  if (camera.motion) camera.motion->move(moment, moved);
  out = std::move(moved);
  return {};
} catch (const detail::LoadError& e) {
  return {e.code, e.what};
} catch (const std::bad_alloc&) {
  return Status::out_of_memory("not enough memory");
}

std::array<double, 2> motion_span(const Camera& camera) {
  return camera.motion ? camera.motion->span() : std::array<double, 2>{0, 0};
}

}  // namespace umbrix::io
