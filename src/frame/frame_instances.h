// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "frame/frame_kernel.h"
#include "index/instance_tree.h"

namespace umbrix::detail {

/// trace_tile, and then instances for the rays that nothing else blocks. Routes and what is remembered are those of
/// the former. Where there is no memory to count with, nothing is counted.
void trace_tile(const InstanceTree& instances, FrameTile& tile) noexcept;

}  // namespace umbrix::detail
