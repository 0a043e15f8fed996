// SPDX-License-Identifier: Apache-2.0
// No stack at all: after each leaf from the root again (Foley & Sugerman 2005).

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/kd_restart.cpp"

#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

#include "kernels/restart_walk-inl.h"
#include "kernels/tree_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {
namespace {

const EntryPoints& kd_restart() { return entry_points<TreeKernel<RestartWalk<false, 0>>>(); }

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
UMBRIX_DEFINE_KERNEL(kKdRestartKernel, kd_restart, "kd-restart", "no stack: from the root again after each leaf",
                     nullptr)
#endif
