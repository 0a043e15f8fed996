// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "stress/checks.h"

namespace umbrix::bench {

/// A row of the stress matrix: cases of its number (cases/table.cpp), or a check of its own.
struct MatrixRow {
  int number;
  const char* name;
  const char* expectation;
  Check* check = nullptr;
  double check_rays = 0;  ///< at scale 1
};

/// All 32, in order.
const std::vector<MatrixRow>& stress_matrix();

/// The rows that a list such as "1,5-9,threads" names, in the matrix's order; all for an empty one.
Status choose_rows(const std::string& list, std::vector<MatrixRow>& out);

}  // namespace umbrix::bench
