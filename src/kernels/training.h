// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "index/training_rays.h"
#include "kernels/kernel.h"

namespace umbrix::detail {

/// The training rays with all triangles that block them, by exact tests: at most 65536, evenly picked; none of those
/// that miss the scene or start far outside it. Of a thousand blockers and more some may be left out. Throws
/// std::bad_alloc.
TrainingRays gather_blockers(const PrepareInput& input);

}  // namespace umbrix::detail
