// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "umbrix/ray.h"
#include "workload/geometry.h"

namespace umbrix::workload {

/// How many of each peer's answers are wrong: where any two peers differ, exact arithmetic decides. The first peer's
/// answers stand for the truth where all agree.
std::vector<std::uint64_t> count_wrong(const Geometry& geometry, const std::vector<Ray>& rays,
                                       const std::vector<const std::vector<std::uint8_t>*>& answers);

}  // namespace umbrix::workload
