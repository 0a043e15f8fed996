// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tree/partition.h"
#include "tree/split.h"
#include "tree/tree.h"
#include "umbrix/executor.h"
#include "umbrix/scene.h"

namespace umbrix::detail {

/// Nodes in the layout of Tree, whose leaves name runs of `references` instead of blocks.
struct UnpackedTree {
  std::vector<Node> nodes;
  std::vector<std::uint32_t> references;  ///< triangles
  std::uint32_t depth = 0;
};

struct SplitOptions {
  PartitionContext context;
  CostModel cost;
  BuildQuality quality = BuildQuality::high;
  const Executor* executor = nullptr;
  std::uint32_t max_depth = kMaxDepth;
  std::uint64_t max_references = 0;
};

/// Splits the cell for as long as the surface area heuristic finds it worth while, subtrees in parallel.
UnpackedTree split_recursively(Cell root, const SplitOptions& options);

}  // namespace umbrix::detail
