// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "oracle/exact_hit.h"
#include "umbrix/ray.h"

/// Triangles and rays on which tracers fail, each kind made by one function from a seed.
namespace umbrix::cases {

struct CaseData {
  std::vector<oracle::Triangle> triangles;
  std::vector<Ray> rays;
};

struct Case {
  const char* name;
  const char* summary;  ///< one line
  /// The same data for the same arguments. Seeds differ in triangles as well as in rays.
  CaseData (*make)(std::uint64_t seed, std::size_t ray_count);
  /// How many rays it gets of a common budget, relative to the others: less where brute force is dear.
  double share = 1;
};

const std::vector<Case>& all_cases();

/// Null if there is none.
const Case* find_case(const char* name);

}  // namespace umbrix::cases
