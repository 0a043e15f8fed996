// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tree/splitter.h"
#include "tree/tree.h"
#include "umbrix/stats.h"

namespace umbrix::detail {

/// Turns the leaves' references into blocks of triangles, in place of the leaves, and counts as it goes.
void pack_leaves(UnpackedTree unpacked, const std::vector<Triangle>& scaled, const CostModel& cost,
                 const Executor* executor, Tree& tree, BuildStats& stats);

}  // namespace umbrix::detail
