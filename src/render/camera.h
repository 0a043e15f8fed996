// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "render/vec.h"
#include "umbrix/io/scene_file.h"
#include "umbrix/ray.h"

namespace umbrix::render {

/// Turns image positions into rays. A ray's t is the distance along the viewing axis, so the depth of a hit is its t
/// and the clipping planes are the ray's interval.
///
/// The vertical extent is the camera's, pixels are square: an image wider or narrower than the camera's own aspect
/// shows more or less at the sides and never distorts.
class Camera {
 public:
  Camera(const io::Camera& camera, int width, int height);

  /// The ray through a point of the image, in pixels from its upper left corner.
  Ray ray(double x, double y) const;

  /// OpenEXR's standard attributes, for row vectors: camera space is left-handed and looks along +z; NDC is (0, 0) at
  /// the upper left and (1, 1) at the lower right corner of the frame.
  std::vector<float> world_to_camera() const;
  std::vector<float> world_to_ndc() const;

 private:
  Vec3 eye_, right_, up_, forward_;
  bool perspective_;
  double half_width_, half_height_;  ///< at depth 1 (perspective) or at any depth (orthographic)
  double width_, height_;            ///< pixels
  float znear_, zfar_;
};

}  // namespace umbrix::render
