// SPDX-License-Identifier: Apache-2.0
#include "render/round_ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace umbrix::render {

double round_step(double span, int most) {
  constexpr double kSlack = 1 + 1e-9;  // 0.6 / 0.2 is not quite 3
  const double least = span / most;
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power * kSlack >= least) return factor * power;
  }
  return 10 * power;
}

std::string tick_label(double value, double step) {
  if (std::abs(value) < step / 2) return "0";
  if (step >= 1e6 || step < 1e-5) {
    const int exponent = 3 * static_cast<int>(std::floor(std::log10(step) / 3 + 1e-9));
    return fmt::format("{:.0f}e{}", value / std::pow(10.0, exponent), exponent);
  }
  const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
  return fmt::format("{:.{}f}", value, decimals);
}

}  // namespace umbrix::render
