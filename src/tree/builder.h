// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/array_view.h"
#include "tree/split.h"
#include "tree/tree.h"
#include "umbrix/executor.h"
#include "umbrix/scene.h"

namespace umbrix::detail {

/// The tree's box, scale and eps for triangles with these bounds; no nodes.
Tree tree_around(const Box& bounds);

/// Builds the tree over the triangles named by `kept` (non-degenerate, finite) and fills the statistics.
/// The result depends on the triangles, their order and the quality only. Throws std::bad_alloc.
Tree build_tree(ArrayView<Triangle> triangles, ArrayView<std::uint32_t> kept, BuildQuality quality,
                const Executor* executor, BuildStats& stats);

}  // namespace umbrix::detail
