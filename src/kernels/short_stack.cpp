// SPDX-License-Identifier: Apache-2.0
// A stack of fixed size, and push-down restarts where it has lost entries (Horn et al. 2007). With four entries
// they add 0 to 4 % to the node tests in rooms and 7 % in foliage; with three 1 to 7 and 13, with eight hardly any.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/short_stack.cpp"

#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

#include "kernels/restart_walk-inl.h"
#include "kernels/tree_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {
namespace {

const EntryPoints& short_stack() { return entry_points<TreeKernel<RestartWalk<true, 4>>>(); }

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
UMBRIX_DEFINE_KERNEL(kShortStackKernel, short_stack, "short-stack", "a stack of four, and restarts when it has run out",
                     nullptr)
#endif
