// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/multiprecision/cpp_int.hpp>

namespace umbrix::oracle {

/// A number mantissa * 2^exponent of any size: what sums and products of floats are. All operations are exact.
class Dyadic {
 public:
  /// Holds 512 bits in place, which is most tests, and grows beyond.
  using Integer =
      boost::multiprecision::number<boost::multiprecision::cpp_int_backend<512>, boost::multiprecision::et_off>;

  Dyadic() = default;
  /// Exactly `value`, which must be finite. Reads the bits, so that no floating-point mode matters.
  explicit Dyadic(float value);

  Dyadic operator-() const { return {-mantissa_, exponent_}; }
  Dyadic operator+(const Dyadic& other) const;
  Dyadic operator-(const Dyadic& other) const { return *this + -other; }
  Dyadic operator*(const Dyadic& other) const { return {mantissa_ * other.mantissa_, exponent_ + other.exponent_}; }

  /// -1, 0 or 1.
  int sign() const { return mantissa_.sign(); }

  /// numerator / denominator (not zero) with a relative error below 2^-52.
  static double ratio(const Dyadic& numerator, const Dyadic& denominator);

 private:
  Dyadic(Integer mantissa, int exponent) : mantissa_(std::move(mantissa)), exponent_(exponent) {}

  Integer mantissa_ = 0;
  int exponent_ = 0;
};

}  // namespace umbrix::oracle
