// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "kernels/scene_view.h"
#include "umbrix/executor.h"

namespace umbrix::detail {

/// What ended a ray, and what it had cost by then.
struct Ending {
  std::uint32_t blocker = Primitive::kNone;
  const Block* block = nullptr;  ///< that holds the blocker, of the tree or the index; null for far rays as well
  bool is_indexed = false;       ///< of the index
  std::uint32_t node_tests = 0;
  std::uint32_t primitive_tests = 0;
};

/// Traces rays as the kernel "indexed" does, with `scene.side` as its index, or without. `skip` as in QueryOptions.
std::vector<Ending> find_endings(const SceneView& scene, RaySpan rays, const Primitive* skip, const Executor* executor);

}  // namespace umbrix::detail
