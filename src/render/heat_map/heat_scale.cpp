// SPDX-License-Identifier: Apache-2.0
#include "render/heat_map/heat_scale.h"

#include <algorithm>
#include <cmath>

#include "render/round_ticks.h"

namespace umbrix::render {
namespace {

constexpr double kShare = 0.995;
constexpr int kMostSteps = 8;

/// The 99.5th percentile of finite values, which it reorders, rounded up to a whole number of steps; 1 if none is above
/// 0.
double suitable_end(std::vector<float>& values, double max) {
  if (!(max > 0)) return 1;
  const auto rank = static_cast<std::ptrdiff_t>(std::ceil(kShare * static_cast<double>(values.size()))) - 1;
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  const double high = values[static_cast<std::size_t>(rank)] > 0 ? values[static_cast<std::size_t>(rank)] : max;
  const double step = round_step(high, kMostSteps);
  return std::ceil(high / step - 1e-9) * step;
}

}  // namespace

HeatScale choose_heat_scale(std::vector<float> values, double end) {
  HeatScale scale;
  const auto finite_end =
      std::partition(values.begin(), values.end(), [](float value) { return std::isfinite(value); });
  scale.without = static_cast<std::size_t>(values.end() - finite_end);
  values.erase(finite_end, values.end());
  if (!values.empty()) {
    double sum = 0;
    for (const float value : values) sum += value;
    scale.mean = sum / static_cast<double>(values.size());
    scale.max = *std::max_element(values.begin(), values.end());
  }
  scale.end = end > 0 ? end : suitable_end(values, scale.max);
  scale.step = round_step(scale.end, kMostSteps);
  scale.clamps = scale.max > scale.end * (1 + 1e-9);
  return scale;
}

}  // namespace umbrix::render
