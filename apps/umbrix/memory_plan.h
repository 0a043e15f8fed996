// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "render_job.h"

namespace umbrix::app {

/// What the rest of the run will hold at most, in bytes, as far as can be told when the scene is read.
struct MemoryPlan {
  std::uint64_t held = 0;   ///< by now, and by the program itself later
  std::uint64_t world = 0;  ///< placed vertices, triangles and tree, while the tree is built
  std::uint64_t image = 0;  ///< while it is written

  std::uint64_t peak() const noexcept { return held + world + image; }
};

MemoryPlan plan_memory(const RenderJob& job);

/// resource_limit if the plan's peak is above the limit; says what does not fit.
Status check_memory(const RenderJob& job);

}  // namespace umbrix::app
