// SPDX-License-Identifier: Apache-2.0
// Groups of rays that share a walk, and what blocked the rays before: see group-inl.h. The default; a FrameTracer also
// remembers from frame to frame.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/auto.cpp"

#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

#include "kernels/batch-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {
namespace {

const EntryPoints& auto_entry_points() { return batch_entry_points<true>(); }

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
UMBRIX_DEFINE_KERNEL(kAutoKernel, auto_entry_points, "auto",
                     "groups of rays; those guessed to be occluded first meet what blocked the last ones",
                     make_wide_tree)
#endif
