// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "umbrix/io/scene_file.h"

namespace umbrix::io {

/// What moves a camera. Never changes once made, so copies of a camera share it.
class CameraMotion {
 public:
  CameraMotion() = default;
  virtual ~CameraMotion();
  CameraMotion(const CameraMotion&) = delete;
  CameraMotion& operator=(const CameraMotion&) = delete;

  /// Sets what changes in `camera`. Throws LoadError if it has no direction then.
  virtual void move(const Moment& moment, Camera& camera) const = 0;

  /// First and last key.
  virtual std::array<double, 2> span() const = 0;
};

}  // namespace umbrix::io
