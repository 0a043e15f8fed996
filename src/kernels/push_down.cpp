// SPDX-License-Identifier: Apache-2.0
// No stack, but restarts from the lowest node that holds the rest of the ray (Horn et al. 2007).

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/push_down.cpp"

#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

#include "kernels/restart_walk-inl.h"
#include "kernels/tree_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {
namespace {

const EntryPoints& push_down() { return entry_points<TreeKernel<RestartWalk<true, 0>>>(); }

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
UMBRIX_DEFINE_KERNEL(kPushDownKernel, push_down, "push-down",
                     "no stack: after each leaf from the lowest node that holds the rest of the ray", nullptr)
#endif
