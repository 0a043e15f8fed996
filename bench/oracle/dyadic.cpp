// SPDX-License-Identifier: Apache-2.0
#include "oracle/dyadic.h"

#include <cmath>
#include <cstdint>
#include <cstring>

namespace umbrix::oracle {

Dyadic::Dyadic(float value) {
  std::uint32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  const int biased = static_cast<int>(bits >> 23 & 0xFFu);
  const std::uint32_t fraction = bits & 0x7FFFFFu;
  const std::uint32_t magnitude = biased == 0 ? fraction : fraction | 0x800000u;
  mantissa_ = magnitude;
  if (bits >> 31 != 0) mantissa_ = -mantissa_;
  exponent_ = (biased == 0 ? 1 : biased) - 150;
}

Dyadic Dyadic::operator+(const Dyadic& other) const {
  if (sign() == 0) return other;
  if (other.sign() == 0) return *this;
  const Dyadic& high = exponent_ >= other.exponent_ ? *this : other;
  const Dyadic& low = exponent_ >= other.exponent_ ? other : *this;
  return {(high.mantissa_ << (high.exponent_ - low.exponent_)) + low.mantissa_, low.exponent_};
}

double Dyadic::ratio(const Dyadic& numerator, const Dyadic& denominator) {
  if (numerator.sign() == 0) return 0;
  const Integer n = abs(numerator.mantissa_);
  const Integer d = abs(denominator.mantissa_);
  // A quotient of 64 bits or more leaves truncation far below a double's last bit.
  const int excess = static_cast<int>(msb(n)) - static_cast<int>(msb(d));
  const int shift = excess < 64 ? 64 - excess : 0;
  const Integer quotient = (n << shift) / d;
  const int drop = static_cast<int>(msb(quotient)) - 63;
  const double top = static_cast<Integer>(quotient >> drop).convert_to<double>();
  const double magnitude = std::ldexp(top, drop - shift + numerator.exponent_ - denominator.exponent_);
  return numerator.sign() == denominator.sign() ? magnitude : -magnitude;
}

}  // namespace umbrix::oracle
