// SPDX-License-Identifier: Apache-2.0
#include "light_estimates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace umbrix::render {

void MeanSum::add(double value) {
  sum_ += value;
  squares_ += value * value;
  ++count_;
}

Mean MeanSum::mean() const {
  const double mean = sum_ / count_;
  return {mean, std::sqrt(std::max(squares_ / count_ - mean * mean, 0.0) / count_)};
}

void expect_mean(const Mean& mean, double expected) {
  constexpr double kSigmas = 5;
  EXPECT_NEAR(mean.value, expected, kSigmas * mean.error + 1e-6 * expected) << "standard error " << mean.error;
}

Mean irradiance(const Light& light, const Receiver& receiver, std::mt19937_64& random) {
  constexpr int kSamples = 20000;
  std::uniform_real_distribution<double> uniform(0, 1);
  MeanSum sum;
  for (int i = 0; i < kSamples; ++i) {
    const double x = uniform(random), y = uniform(random);
    const Arrival arrival = light.sample(receiver, {x, y});
    const bool arrives = arrival.unreached == Unreached::no;
    const double cosine = arrives ? glm::dot(glm::normalize(arrival.to_light), receiver.normal) : 0;
    sum.add(arrival.irradiance.g * std::max(cosine, 0.0));
  }
  return sum.mean();
}

Receiver receiver(const Vec3& point, const Vec3& normal) { return {point, point, normal}; }

Vec3 unit_vector(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const double x = normal(random), y = normal(random), z = normal(random);
  return glm::normalize(Vec3(x, y, z));
}

}  // namespace umbrix::render
