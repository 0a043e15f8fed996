// SPDX-License-Identifier: Apache-2.0
//
// Signed volumes (Pluecker coordinates): with a, b, c the vertices seen from the origin and d the direction, the
// weights w0 = d.(b x c), w1 = d.(c x a), w2 = d.(a x b) have one sign exactly if the line meets the closed triangle.
// Their sum is d.n for the normal n = (b - a) x (c - a), and t = a.(b x c) / d.n.
#include "oracle/exact_hit.h"

#include <array>
#include <cmath>

namespace umbrix::oracle {
namespace {

using Vector = std::array<Dyadic, 3>;

Vector exact(const float v[3]) { return {Dyadic(v[0]), Dyadic(v[1]), Dyadic(v[2])}; }

Vector difference(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

Dyadic dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

bool all_finite(const float v[3]) { return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]); }

// Whether t_numerator / denominator > bound, for a positive denominator.
bool is_above(const Dyadic& t_numerator, const Dyadic& denominator, float bound) {
  if (std::isinf(bound)) return bound < 0;
  return (t_numerator - Dyadic(bound) * denominator).sign() > 0;
}

bool is_below(const Dyadic& t_numerator, const Dyadic& denominator, float bound) {
  if (std::isinf(bound)) return bound > 0;
  return (t_numerator - Dyadic(bound) * denominator).sign() < 0;
}

}  // namespace

bool is_valid(const Ray& ray) {
  if (!all_finite(ray.origin) || !all_finite(ray.direction)) return false;
  if (Dyadic(ray.direction[0]).sign() == 0 && Dyadic(ray.direction[1]).sign() == 0 &&
      Dyadic(ray.direction[2]).sign() == 0) {
    return false;
  }
  if (std::isnan(ray.tmin) || std::isnan(ray.tmax)) return false;
  if (std::isinf(ray.tmin) || std::isinf(ray.tmax)) return ray.tmin < ray.tmax;
  return (Dyadic(ray.tmin) - Dyadic(ray.tmax)).sign() < 0;  // a float compare would read denormals as zeros under DAZ
}

std::optional<ExactHit> exact_intersection(const Ray& ray, const float v[3][3]) {
  if (!is_valid(ray) || !all_finite(v[0]) || !all_finite(v[1]) || !all_finite(v[2])) return std::nullopt;
  const Vector origin = exact(ray.origin);
  const Vector d = exact(ray.direction);
  const Vector a = difference(exact(v[0]), origin);
  const Vector b = difference(exact(v[1]), origin);
  const Vector c = difference(exact(v[2]), origin);
  const Vector b_cross_c = cross(b, c);

  // One sign for all three weights, or the line misses; no sum, and it lies in the plane.
  std::array<Dyadic, 3> weight = {dot(d, b_cross_c), dot(d, cross(c, a)), dot(d, cross(a, b))};
  Dyadic denominator = weight[0] + weight[1] + weight[2];
  const int side = denominator.sign();
  if (side == 0) return std::nullopt;
  for (const Dyadic& w : weight) {
    if (w.sign() == -side) return std::nullopt;
  }

  Dyadic t_numerator = dot(a, b_cross_c);
  if (side < 0) {
    t_numerator = -t_numerator;
    denominator = -denominator;
    for (Dyadic& w : weight) w = -w;
  }
  if (!is_above(t_numerator, denominator, ray.tmin) || !is_below(t_numerator, denominator, ray.tmax)) {
    return std::nullopt;
  }
  return ExactHit{t_numerator, weight[1], weight[2], denominator};
}

bool exact_hit(const Ray& ray, const float v[3][3]) { return exact_intersection(ray, v).has_value(); }

int compare_t(const ExactHit& a, const ExactHit& b) {
  return (a.t_numerator * b.denominator - b.t_numerator * a.denominator).sign();
}

}  // namespace umbrix::oracle
