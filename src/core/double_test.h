// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/math.h"
#include "umbrix/ray.h"

namespace umbrix::detail {

/// What a test of limited precision can say.
enum class Verdict { miss, hit, undecided };

/// The ray/triangle test in double with running error bounds. Values have det's sign taken out:
/// u = U/det, v = V/det, t = T/det with det >= 0 as computed.
struct DoubleTest {
  Verdict verdict = Verdict::undecided;
  double det = 0, u = 0, v = 0, t = 0;  ///< numerators, and det
  double det_error = 0, t_error = 0;    ///< bounds on the absolute errors of det and of the numerator t
};

/// Needs finite ray and vertices (the interval may be infinite) and the default floating-point mode.
DoubleTest test_in_double(const Ray& ray, const Triangle& triangle) noexcept;

}  // namespace umbrix::detail
