// SPDX-License-Identifier: Apache-2.0
// Urena, Fajardo & King 2013, "An Area-Preserving Parametrization for Spherical Rectangles", algorithms 1 and 2.
#include "render/sampling/spherical_rectangle.h"

#include <algorithm>
#include <cmath>

namespace umbrix::render {
namespace {

/// The inner angle between two sides of a spherical polygon, from the sides' normals.
double inner_angle(const Vec3& a, const Vec3& b) { return std::acos(std::clamp(-glm::dot(a, b), -1.0, 1.0)); }

}  // namespace

SphericalRectangle::SphericalRectangle(const Rectangle& rectangle, const Vec3& viewpoint) {
  const Vec3 to_centre = rectangle.centre - viewpoint;
  for (int axis = 0; axis < 2; ++axis) {
    middle_[axis] = glm::dot(to_centre, rectangle.axes[axis]);
    low_[axis] = middle_[axis] - rectangle.half_size[axis];
    high_[axis] = middle_[axis] + rectangle.half_size[axis];
  }
  depth_ = -std::abs(glm::dot(to_centre, glm::cross(rectangle.axes[0], rectangle.axes[1])));

  // Normals of the four sides, as planes through the viewpoint.
  const Vec3 v00(low_[0], low_[1], depth_), v01(low_[0], high_[1], depth_);
  const Vec3 v10(high_[0], low_[1], depth_), v11(high_[0], high_[1], depth_);
  const Vec3 n0 = glm::normalize(glm::cross(v00, v10)), n1 = glm::normalize(glm::cross(v10, v11));
  const Vec3 n2 = glm::normalize(glm::cross(v11, v01)), n3 = glm::normalize(glm::cross(v01, v00));

  b0_ = n0.z;
  b1_ = n2.z;
  k_ = 2 * kPi - inner_angle(n2, n3) - inner_angle(n3, n0);
  solid_angle_ = inner_angle(n0, n1) + inner_angle(n1, n2) - k_;
}

SamplePoint SphericalRectangle::point(const SamplePoint& u) const {
  // The column that has u.x of the solid angle on its left.
  const double angle = u.x * solid_angle_ + k_;
  const double f = (std::cos(angle) * b0_ - b1_) / std::sin(angle);
  const double cosine = std::clamp(std::copysign(1 / std::sqrt(f * f + b0_ * b0_), f), -1.0, 1.0);
  const double x = std::clamp(-cosine * depth_ / std::sqrt(1 - cosine * cosine), low_[0], high_[0]);

  // The place in that column.
  const double distance2 = x * x + depth_ * depth_;
  const double h0 = low_[1] / std::sqrt(distance2 + low_[1] * low_[1]);
  const double h1 = high_[1] / std::sqrt(distance2 + high_[1] * high_[1]);
  const double h = h0 + u.y * (h1 - h0);
  const double y = std::clamp(h * std::sqrt(distance2 / (1 - h * h)), low_[1], high_[1]);
  return {x - middle_[0], y - middle_[1]};
}

}  // namespace umbrix::render
