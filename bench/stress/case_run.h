// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cases/cases.h"
#include "stress/counts.h"
#include "umbrix/status.h"

namespace umbrix::bench {

struct StressSettings {
  double scale = 1;
  std::uint64_t seed = 1;
  std::string regressions;  ///< file for minimised failures; empty: none
};

/// Asks kernels and Embree the case's rays, scene after scene, and adds what came of it. Most scenes are asked two
/// kernels, all of which take turns with all instruction sets; some are asked every kernel on every instruction set.
/// Wrong answers are printed in full, the first few of them.
Status run_case(const cases::Case& c, const StressSettings& settings, Counts& out);

}  // namespace umbrix::bench
