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
  double least_share = 0;  ///< of the rays that enter a node, blocked by the triangle: gains alone choose best
  std::uint32_t per_node = kBlockLanes;  ///< triangles; a list costs about one test whatever it holds
  double least_gain = 0.02;              ///< of the rays' work, and not by chance: with less, nothing is placed
};

/// Which triangles to test at which nodes, for rays like these: where the node steps and tests that the rays would have
/// been spared exceed the tests they would have made. No triangle is twice on one path from the root. The same rays
/// give the same placements. Throws std::bad_alloc.
std::vector<Placement> select_learned(const Tree& tree, const BlockedRays& traced, const LearnedOptions& options = {});

}  // namespace umbrix::detail
