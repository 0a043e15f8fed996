// SPDX-License-Identifier: Apache-2.0
#include "render/sampling/discrete_distribution.h"

#include <algorithm>
#include <cmath>

namespace umbrix::render {
namespace {

/// The largest double below 1.
constexpr double kBelowOne = 1 - 0x1p-53;

}  // namespace

DiscreteDistribution::DiscreteDistribution(const std::vector<double>& weights) {
  sums_.reserve(weights.size());
  double sum = 0;
  for (const double weight : weights) {
    if (weight > 0 && std::isfinite(weight)) sum += weight;
    sums_.push_back(sum);
  }
}

Choice DiscreteDistribution::choose(double u) const {
  // The first sum above u * total; were rounding to bring that up to the total, the last index with a weight.
  const double wanted = std::min(u * total(), std::nextafter(total(), 0.0));
  const auto found = std::upper_bound(sums_.begin(), sums_.end(), wanted);
  const double below = found == sums_.begin() ? 0 : *(found - 1);
  const double weight = *found - below;
  return {static_cast<std::size_t>(found - sums_.begin()), weight / total(),
          std::min((wanted - below) / weight, kBelowOne)};
}

double DiscreteDistribution::probability(std::size_t index) const {
  return (sums_[index] - (index == 0 ? 0 : sums_[index - 1])) / total();
}

}  // namespace umbrix::render
