// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render/pixel_samples.h"
#include "render/vec.h"

namespace umbrix::render {

/// A flat rectangle.
struct Rectangle {
  Vec3 centre;
  Vec3 axes[2];         ///< unit, orthogonal
  double half_size[2];  ///< along the axes
};

/// A rectangle as a point sees it, for points that are uniform in the directions they are seen in.
class SphericalRectangle {
 public:
  SphericalRectangle(const Rectangle& rectangle, const Vec3& viewpoint);

  /// Steradian; good to about 1e-15, so that small ones have few digits.
  double solid_angle() const { return solid_angle_; }

  /// The rectangle's point for `u`: centre + x axes[0] + y axes[1].
  SamplePoint point(const SamplePoint& u) const;

 private:
  double middle_[2];                 ///< of the rectangle along its axes, seen from the viewpoint
  double low_[2], high_[2], depth_;  ///< depth_ < 0: the plane is at that height on the third axis
  double b0_, b1_, k_, solid_angle_;
};

}  // namespace umbrix::render
