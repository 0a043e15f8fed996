// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "cases/cases.h"
#include "stress/counts.h"
#include "umbrix/status.h"

namespace umbrix::bench {

WrongRays count_wrong(const std::vector<std::uint8_t>& answers, const std::vector<std::uint8_t>& truth);

/// Asks Embree, robust and fast, one ray a call, the rays that it accepts. Embree leaves open what lies at, or very
/// near, the ends of a ray: an answer that is right for ends moved by up to kOpenEnds units in the last place is not
/// counted as wrong but as `embree_at_ends`.
inline constexpr int kOpenEnds = 4;
Status count_embree_errors(const cases::CaseData& data, const std::vector<std::uint8_t>& truth, Counts& out);

}  // namespace umbrix::bench
