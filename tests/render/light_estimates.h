// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>

#include "render/lights/light.h"

namespace umbrix::render {

/// A mean of independent values, and its standard error as estimated from them.
struct Mean {
  double value = 0, error = 0;
};

class MeanSum {
 public:
  void add(double value);
  Mean mean() const;

 private:
  double sum_ = 0, squares_ = 0, count_ = 0;
};

/// The mean must lie within 5 standard errors of the truth (if all is right, one check in two million fails by chance),
/// and a millionth for rounding.
void expect_mean(const Mean& mean, double expected);

/// On the receiver, in green: the mean of what 20000 samples bring.
Mean irradiance(const Light& light, const Receiver& receiver, std::mt19937_64& random);

/// One whose point needs no offset.
Receiver receiver(const Vec3& point, const Vec3& normal);

Vec3 unit_vector(std::mt19937_64& random);

}  // namespace umbrix::render
