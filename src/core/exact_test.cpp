// SPDX-License-Identifier: Apache-2.0
// The determinants of double_test.cpp in fixed-width integers. Floats are integers times a power of two: positions and
// vertices in units of 2^c, the direction in units of 2^d, c and d the smallest exponents that occur. The largest
// value is then below 2^1310 and the product of two below 2^1680, so that nothing overflows or allocates.
// Floats are taken apart by their bits, which no rounding mode or flush-to-zero can disturb.

#include "core/exact_test.h"

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace umbrix::detail {
namespace {

namespace mp = boost::multiprecision;
using Int = mp::number<mp::cpp_int_backend<2048, 2048, mp::signed_magnitude, mp::unchecked, void>, mp::et_off>;

/// mantissa * 2^exponent
struct Decomposed {
  std::int32_t mantissa;
  int exponent;
};

constexpr int kNoExponent = 1000;

Decomposed decompose(float x) noexcept {
  std::uint32_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  const std::int32_t fraction = static_cast<std::int32_t>(bits & 0x7FFFFFu);
  const int biased = static_cast<int>((bits >> 23) & 0xFFu);
  const std::int32_t mantissa = biased ? (fraction | 0x800000) : fraction;
  return {(bits >> 31) ? -mantissa : mantissa, (biased ? biased : 1) - 150};
}

int lowest_exponent(const float* values, int count) noexcept {
  int lowest = kNoExponent;
  for (int i = 0; i < count; ++i) {
    const Decomposed x = decompose(values[i]);
    if (x.mantissa) lowest = std::min(lowest, x.exponent);
  }
  return lowest;
}

Int scaled(float value, int unit) {
  const Decomposed x = decompose(value);
  if (!x.mantissa) return 0;
  Int result = x.mantissa;
  result <<= x.exponent - unit;
  return result;
}

struct IntVec {
  Int x, y, z;
};

IntVec scaled(const float* p, int unit) { return {scaled(p[0], unit), scaled(p[1], unit), scaled(p[2], unit)}; }
IntVec scaled(const Vec3& p, int unit) { return scaled(&p.x, unit); }
IntVec operator-(const IntVec& a, const IntVec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
IntVec cross(const IntVec& a, const IntVec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Int dot(const IntVec& a, const IntVec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// det, U, V and T of one pair, det's sign taken out.
struct Determinants {
  Int det, u, v, t;
};

struct Units {
  int position = 0;
  int direction = 0;

  Units(const Ray& ray, const Triangle* triangles, int count) noexcept {
    int lowest = lowest_exponent(ray.origin, 3);
    for (int i = 0; i < count; ++i)
      for (const Vec3& v : triangles[i].v) lowest = std::min(lowest, lowest_exponent(&v.x, 3));
    position = lowest == kNoExponent ? 0 : lowest;
    lowest = lowest_exponent(ray.direction, 3);
    direction = lowest == kNoExponent ? 0 : lowest;
  }
};

Determinants determinants(const Ray& ray, const Triangle& triangle, const Units& units) {
  const IntVec v0 = scaled(triangle.v[0], units.position);
  const IntVec e1 = scaled(triangle.v[1], units.position) - v0;
  const IntVec e2 = scaled(triangle.v[2], units.position) - v0;
  const IntVec d = scaled(ray.direction, units.direction);
  const IntVec s = scaled(ray.origin, units.position) - v0;
  const IntVec p = cross(d, e2);
  const IntVec q = cross(s, e1);
  Determinants result{dot(e1, p), dot(s, p), dot(d, q), dot(e2, q)};
  if (result.det.sign() < 0) {
    result.det = -result.det;
    result.u = -result.u;
    result.v = -result.v;
    result.t = -result.t;
  }
  return result;
}

/// The sign of T/det - end, for det > 0 and a finite end.
int compare_with_end(const Determinants& x, float end, const Units& units) {
  const Decomposed e = decompose(end);
  Int numerator = x.t;
  Int scaled_end = x.det * e.mantissa;
  const int shift = units.position - e.exponent - units.direction;
  if (shift >= 0)
    numerator <<= shift;
  else
    scaled_end <<= -shift;
  return numerator.compare(scaled_end);
}

/// a / b as a double, for b > 0 and any size.
double quotient(Int a, Int b) {
  const bool negative = a.sign() < 0;
  if (negative) a = -a;
  if (a.is_zero()) return 0;
  const int a_excess = std::max(0, static_cast<int>(mp::msb(a)) - 900);
  const int b_excess = std::max(0, static_cast<int>(mp::msb(b)) - 900);
  a >>= a_excess;
  b >>= b_excess;
  const double q = std::ldexp(a.convert_to<double>() / b.convert_to<double>(), a_excess - b_excess);
  return negative ? -q : q;
}

}  // namespace

bool hits_exactly(const Ray& ray, const Triangle& triangle) noexcept {
  const Units units(ray, &triangle, 1);
  const Determinants x = determinants(ray, triangle, units);
  if (x.det.is_zero() || x.u.sign() < 0 || x.v.sign() < 0 || x.u + x.v > x.det) return false;
  if (std::isinf(ray.tmin) ? ray.tmin > 0 : compare_with_end(x, ray.tmin, units) <= 0) return false;
  return std::isinf(ray.tmax) ? ray.tmax > 0 : compare_with_end(x, ray.tmax, units) < 0;
}

int compare_t_exactly(const Ray& ray, const Triangle& a, const Triangle& b) noexcept {
  const Triangle both[2] = {a, b};
  const Units units(ray, both, 2);
  const Determinants x = determinants(ray, a, units);
  const Determinants y = determinants(ray, b, units);
  return Int(x.t * y.det).compare(y.t * x.det);
}

HitParameters exact_parameters(const Ray& ray, const Triangle& triangle) noexcept {
  const Units units(ray, &triangle, 1);
  const Determinants x = determinants(ray, triangle, units);
  return {std::ldexp(quotient(x.t, x.det), units.position - units.direction), quotient(x.u, x.det),
          quotient(x.v, x.det)};
}

bool is_degenerate(const Triangle& triangle) noexcept {
  const DVec3 v0(triangle.v[0]);
  const DVec3 e1 = DVec3(triangle.v[1]) - v0;
  const DVec3 e2 = DVec3(triangle.v[2]) - v0;
  for (int axis = 2; axis >= 0; --axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const double plus = e1[u] * e2[v], minus = e1[v] * e2[u];
    // Five roundings at most: two differences, a product and the difference of products.
    if (std::abs(plus - minus) > 0x1p-50 * (std::abs(plus) + std::abs(minus))) return false;
  }

  const Ray nowhere{};
  const int unit = Units(nowhere, &triangle, 1).position;
  const IntVec w0 = scaled(triangle.v[0], unit);
  const IntVec n = cross(scaled(triangle.v[1], unit) - w0, scaled(triangle.v[2], unit) - w0);
  return n.x.is_zero() && n.y.is_zero() && n.z.is_zero();
}

}  // namespace umbrix::detail
