// SPDX-License-Identifier: Apache-2.0
#include "error/statistics.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <numeric>

namespace umbrix::bench {
namespace {

constexpr double kEachSide = 0.025;

/// Of sorted values.
double quantile(const std::vector<double>& values, double share) {
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

}  // namespace

Estimate share_of(std::uint64_t count, std::uint64_t trials) {
  using Binomial = boost::math::binomial_distribution<double>;
  if (trials == 0) return {0, 0, 1};
  const auto n = static_cast<double>(trials), k = static_cast<double>(count);
  return {k / n, Binomial::find_lower_bound_on_p(n, k, kEachSide), Binomial::find_upper_bound_on_p(n, k, kEachSide)};
}

Estimate median_and_quartiles(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  return {quantile(values, 0.5), quantile(values, 0.25), quantile(values, 0.75)};
}

Estimate mean_interval(const std::vector<double>& values, double other_variance) {
  if (values.empty()) return {};
  const auto n = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  if (values.size() == 1) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    return {mean, -kInfinity, kInfinity};
  }
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  const boost::math::students_t_distribution<double> t(n - 1);
  const double half =
      boost::math::quantile(boost::math::complement(t, kEachSide)) * std::sqrt(squares / (n - 1) / n + other_variance);
  return {mean, mean - half, mean + half};
}

}  // namespace umbrix::bench
