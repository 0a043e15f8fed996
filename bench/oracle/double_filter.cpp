// SPDX-License-Identifier: Apache-2.0
//
// The signed volumes of exact_hit.cpp in double, each with a bound on its rounding error. Doubles neither overflow nor
// underflow here: non-zero terms of degree 4 in floats lie within 2^-596 .. 2^520.
#include "oracle/double_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace umbrix::oracle {
namespace {

using Double3 = std::array<double, 3>;

// A value and a bound on its error.
struct Bounded {
  double value;
  double error;

  bool positive() const { return value > error; }
  bool negative() const { return value < -error; }
};

// At most 11 roundings lie on any path (Higham 2002, lemma 3.1: gamma_11 of the sum of absolute terms); 16 units cover
// them and the rounding of the bound itself.
constexpr double kUnits = 16 * 0x1p-53;

// x . (y x z), with the sum of the absolute values of its six terms.
Bounded volume(const Double3& x, const Double3& y, const Double3& z) {
  double value = 0;
  double terms = 0;
  for (int i = 0; i < 3; ++i) {
    const auto j = static_cast<std::size_t>((i + 1) % 3);
    const auto k = static_cast<std::size_t>((i + 2) % 3);
    const double left = y[j] * z[k];
    const double right = y[k] * z[j];
    value += x[static_cast<std::size_t>(i)] * (left - right);
    terms += std::abs(x[static_cast<std::size_t>(i)]) * (std::abs(left) + std::abs(right));
  }
  return {value, kUnits * terms};
}

Double3 seen_from(const float point[3], const float origin[3]) {
  return {double{point[0]} - origin[0], double{point[1]} - origin[1], double{point[2]} - origin[2]};
}

// The sign of t - limit, as far as it is certain.
Bounded distance_to_limit(const Bounded& t_numerator, const Bounded& denominator, float limit) {
  return {t_numerator.value - double{limit} * denominator.value,
          t_numerator.error + std::abs(double{limit}) * denominator.error};
}

Verdict inside_interval(const Bounded& t_numerator, const Bounded& denominator, const Ray& ray) {
  bool certain = true;
  if (ray.tmin != -std::numeric_limits<float>::infinity()) {
    const Bounded above = distance_to_limit(t_numerator, denominator, ray.tmin);
    if (above.negative()) return Verdict::miss;
    certain = certain && above.positive();
  }
  if (ray.tmax != std::numeric_limits<float>::infinity()) {
    const Bounded beyond = distance_to_limit(t_numerator, denominator, ray.tmax);
    if (beyond.positive()) return Verdict::miss;
    certain = certain && beyond.negative();
  }
  return certain ? Verdict::hit : Verdict::open;
}

}  // namespace

Filtered filter(const Ray& ray, const Triangle& triangle) {
  const Double3 d = {ray.direction[0], ray.direction[1], ray.direction[2]};
  const Double3 a = seen_from(triangle.v[0], ray.origin);
  const Double3 b = seen_from(triangle.v[1], ray.origin);
  const Double3 c = seen_from(triangle.v[2], ray.origin);
  const Bounded w[3] = {volume(d, b, c), volume(d, c, a), volume(d, a, b)};

  // Two weights of certainly opposite sign: a miss, whatever the third.
  const bool any_positive = w[0].positive() || w[1].positive() || w[2].positive();
  const bool any_negative = w[0].negative() || w[1].negative() || w[2].negative();
  if (any_positive && any_negative) return {Verdict::miss};

  Bounded denominator = {w[0].value + w[1].value + w[2].value, w[0].error + w[1].error + w[2].error};
  Bounded t_numerator = volume(a, b, c);
  if (!denominator.positive() && !denominator.negative()) return {Verdict::open};
  if (denominator.negative()) {
    denominator.value = -denominator.value;
    t_numerator.value = -t_numerator.value;
  }
  const Verdict in_t = inside_interval(t_numerator, denominator, ray);
  if (in_t == Verdict::miss) return {Verdict::miss};
  const bool certain_inside = (w[0].positive() && w[1].positive() && w[2].positive()) ||
                              (w[0].negative() && w[1].negative() && w[2].negative());
  Filtered result = {certain_inside ? in_t : Verdict::open};
  const auto quotient = [&](double numerator) {
    const double x = numerator / (denominator.value + denominator.error);
    const double y = numerator / (denominator.value - denominator.error);
    return std::pair<double, double>(std::min(x, y), std::max(x, y));
  };
  // Outward by far more than the divisions' own rounding.
  const double low = quotient(t_numerator.value - t_numerator.error).first;
  const double high = quotient(t_numerator.value + t_numerator.error).second;
  result.t_lower = low - std::abs(low) * 1e-14;
  result.t_upper = high + std::abs(high) * 1e-14;
  return result;
}

}  // namespace umbrix::oracle
