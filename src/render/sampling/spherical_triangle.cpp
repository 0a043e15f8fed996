// SPDX-License-Identifier: Apache-2.0
// Arvo 1995, "Stratified Sampling of Spherical Triangles", as revised by Pharr, Jakob & Humphreys 2023, section 6.5.4.
#include "render/sampling/spherical_triangle.h"

#include <algorithm>
#include <cmath>

namespace umbrix::render {
namespace {

/// Between unit vectors; accurate for near and for opposite ones too (Kahan, by way of Pharr et al., section 3.3.2).
double angle_between(const Vec3& a, const Vec3& b) {
  const double half_chord = 0.5 * glm::length(glm::dot(a, b) < 0 ? a + b : a - b);
  const double angle = 2 * std::asin(std::min(half_chord, 1.0));
  return glm::dot(a, b) < 0 ? kPi - angle : angle;
}

/// What of `v` is orthogonal to the unit vector `w`, at unit length.
Vec3 orthogonal_part(const Vec3& v, const Vec3& w) { return glm::normalize(v - glm::dot(v, w) * w); }

double sine_of(double cosine) { return std::sqrt(std::max(1 - cosine * cosine, 0.0)); }

}  // namespace

SphericalTriangle::SphericalTriangle(const Vec3 (&corners)[3], const Vec3& viewpoint)
    : edge1_(corners[1] - corners[0]),
      edge2_(corners[2] - corners[0]),
      from_corner_(viewpoint - corners[0]),
      a_(glm::normalize(corners[0] - viewpoint)),
      b_(glm::normalize(corners[1] - viewpoint)),
      c_(glm::normalize(corners[2] - viewpoint)) {
  Vec3 ab = glm::cross(a_, b_), bc = glm::cross(b_, c_), ca = glm::cross(c_, a_);
  if (ab == Vec3(0) || bc == Vec3(0) || ca == Vec3(0)) return;
  ab = glm::normalize(ab);
  bc = glm::normalize(bc);
  ca = glm::normalize(ca);
  alpha_ = angle_between(ab, -ca);
  // Girard's theorem.
  solid_angle_ = std::max(alpha_ + angle_between(bc, -ab) + angle_between(ca, -bc) - kPi, 0.0);
}

SamplePoint SphericalTriangle::point(const SamplePoint& u) const {
  // Cut off the part a, b, c' with u.x of the area: c' lies on the side from a to c.
  const double area_and_pi = u.x * solid_angle_ + kPi;
  const double cos_alpha = std::cos(alpha_), sin_alpha = std::sin(alpha_);
  const double sin_phi = std::sin(area_and_pi) * cos_alpha - std::cos(area_and_pi) * sin_alpha;
  const double cos_phi = std::cos(area_and_pi) * cos_alpha + std::sin(area_and_pi) * sin_alpha;
  const double k1 = cos_phi + cos_alpha;
  const double k2 = sin_phi - sin_alpha * glm::dot(a_, b_);
  const double numerator = k2 + (k2 * cos_phi - k1 * sin_phi) * cos_alpha;
  const double denominator = (k2 * sin_phi + k1 * cos_phi) * sin_alpha;
  const double cos_b = denominator != 0 ? std::clamp(numerator / denominator, -1.0, 1.0) : 1.0;
  const Vec3 cut = cos_b * a_ + sine_of(cos_b) * orthogonal_part(c_, a_);

  // A direction on the arc from b to c'.
  const double cos_theta = 1 - u.y * (1 - glm::dot(cut, b_));
  const Vec3 direction = cos_theta * b_ + sine_of(cos_theta) * orthogonal_part(cut, b_);

  // Where it meets the triangle (Moller & Trumbore 1997).
  const Vec3 s1 = glm::cross(direction, edge2_);
  const double inverse = 1 / glm::dot(s1, edge1_);
  const double b1 = std::max(glm::dot(from_corner_, s1) * inverse, 0.0);
  const double b2 = std::max(glm::dot(direction, glm::cross(from_corner_, edge1_)) * inverse, 0.0);
  const double sum = std::max(b1 + b2, 1.0);
  return {b1 / sum, b2 / sum};
}

}  // namespace umbrix::render
