// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "index/primitive_index.h"
#include "umbrix/ray.h"

namespace umbrix::detail {

/// Rays that were traced, and the triangle that each was found to be blocked by (none: Primitive::kNone).
struct BlockedRays {
  RaySpan rays;
  const std::uint32_t* blockers;
};

struct LearnedOptions {
  double least_share = 0.05;     ///< of the rays that enter a node, blocked by the triangle
  std::uint32_t least_hits = 2;  ///< rays blocked by it there: fewer are chance
  std::uint32_t per_node = 4;    ///< triangles; at most kBlockLanes
  double least_gain = 0.02;      ///< of the rays' work: with less, nothing is placed
};

/// Which triangles to test at which nodes, for rays like these: where the node steps and tests that the rays would have
/// been spared exceed the tests they would have made. No triangle is twice on one path from the root. The same rays give
/// the same placements. Throws std::bad_alloc.
std::vector<Placement> select_learned(const Tree& tree, const BlockedRays& traced, const LearnedOptions& options = {});

}  // namespace umbrix::detail
