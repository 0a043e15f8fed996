// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "oracle/exact_hit.h"

namespace umbrix::oracle {

/// What doubles with a bound on their error can say of a ray and a triangle.
enum class Verdict { miss, hit, open };

struct Filtered {
  Verdict verdict;
  /// Where t lies, unless it is a miss.
  double t_lower = -std::numeric_limits<double>::infinity();
  double t_upper = std::numeric_limits<double>::infinity();
};

/// Needs a valid ray and the default floating-point mode.
Filtered filter(const Ray& ray, const Triangle& triangle);

}  // namespace umbrix::oracle
