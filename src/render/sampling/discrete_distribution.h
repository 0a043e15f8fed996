// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace umbrix::render {

/// What a DiscreteDistribution chose.
struct Choice {
  std::size_t index = 0;
  double probability = 0;  ///< of that index
  double rest = 0;         ///< what the choice left of its random number, in [0, 1) and uniform again
};

/// Chooses numbers 0, 1, ... with probabilities in proportion to weights, in order: neighbouring random numbers choose
/// neighbouring indices, so that stratification survives.
class DiscreteDistribution {
 public:
  DiscreteDistribution() = default;
  /// Weights that are not positive and finite are never chosen.
  explicit DiscreteDistribution(const std::vector<double>& weights);

  /// The sum of the weights; if it is 0 there is nothing to choose.
  double total() const { return sums_.empty() ? 0 : sums_.back(); }

  /// For u in [0, 1), if the total is not 0.
  Choice choose(double u) const;

  /// Of an index, if the total is not 0.
  double probability(std::size_t index) const;

 private:
  std::vector<double> sums_;  ///< of the weights up to and with each
};

}  // namespace umbrix::render
