// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cfenv>
#include <limits>

#include "oracle/exact_hit.h"

namespace umbrix::oracle {

enum class Verdict { miss, hit, open };

/// What doubles can tell of a ray and a triangle: `miss` and `hit` are certain, and a hit's t lies in between.
struct Filtered {
  Verdict verdict;
  double t_lower = -std::numeric_limits<double>::infinity();
  double t_upper = std::numeric_limits<double>::infinity();
};

/// For a valid ray, under a DefaultFloatMode.
Filtered filter(const Ray& ray, const Triangle& triangle);

/// While it lives, IEEE rounding and denormals, on which bounds depend, whatever mode a host or a test has set.
class DefaultFloatMode {
 public:
  DefaultFloatMode() {
    std::fegetenv(&saved_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~DefaultFloatMode() { std::fesetenv(&saved_); }
  DefaultFloatMode(const DefaultFloatMode&) = delete;
  DefaultFloatMode& operator=(const DefaultFloatMode&) = delete;

 private:
  std::fenv_t saved_;
};

}  // namespace umbrix::oracle
