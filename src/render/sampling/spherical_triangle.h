// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render/pixel_samples.h"
#include "render/vec.h"

namespace umbrix::render {

/// A triangle as a point sees it, for points that are uniform in the directions they are seen in.
class SphericalTriangle {
 public:
  SphericalTriangle(const Vec3 (&corners)[3], const Vec3& viewpoint);

  /// Steradian; good to about 1e-15, so that small ones have few digits. 0 if the point lies in the plane.
  double solid_angle() const { return solid_angle_; }

  /// Barycentric coordinates of the triangle's second and third corner for `u`, if the solid angle is not 0.
  SamplePoint point(const SamplePoint& u) const;

 private:
  Vec3 edge1_, edge2_, from_corner_;
  Vec3 a_, b_, c_;  ///< unit, to the corners
  double alpha_ = 0, solid_angle_ = 0;
};

}  // namespace umbrix::render
