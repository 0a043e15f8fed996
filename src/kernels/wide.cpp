// SPDX-License-Identifier: Apache-2.0
// Single rays over the tree folded to eight children a node (Wald, Benthin & Boulos 2008, "Getting rid of packets").

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/wide.cpp"

#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

#include "kernels/tree_kernel-inl.h"
#include "kernels/wide_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {
namespace {

const EntryPoints& wide() { return entry_points<TreeKernel<WideWalk>>(); }

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
UMBRIX_DEFINE_KERNEL(kWideKernel, wide, "wide", "the tree folded to eight children a node, where rays want it",
                     make_wide_tree)
#endif
