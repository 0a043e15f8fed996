// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "oracle/dyadic.h"
#include "umbrix/ray.h"

/// The exact judge: slow, simple, and written without a look at the tracer's own numbers.
namespace umbrix::oracle {

struct Triangle {
  float v[3][3];
};

/// A hit's parameters as fractions over one positive denominator: t = t_numerator / denominator, and so on.
struct ExactHit {
  Dyadic t_numerator;
  Dyadic u_numerator;
  Dyadic v_numerator;
  Dyadic denominator;

  double t() const { return Dyadic::ratio(t_numerator, denominator); }
  double u() const { return Dyadic::ratio(u_numerator, denominator); }
  double v() const { return Dyadic::ratio(v_numerator, denominator); }
};

/// Whether the ray can hit anything: finite origin and direction, a direction that is not zero, tmin < tmax.
bool is_valid(const Ray& ray);

/// The hit of real arithmetic, if there is one: tmin < t < tmax on the closed triangle. A ray in the triangle's plane,
/// a triangle without area or with a vertex that is not finite, and a ray that is not valid hit nothing.
std::optional<ExactHit> exact_intersection(const Ray& ray, const float v[3][3]);

/// Whether there is one.
bool exact_hit(const Ray& ray, const float v[3][3]);

/// Whether a's t is smaller than (-1), equal to (0) or larger than (1) b's, exactly.
int compare_t(const ExactHit& a, const ExactHit& b);

}  // namespace umbrix::oracle
