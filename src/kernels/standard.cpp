// SPDX-License-Identifier: Apache-2.0
// The textbook walk: from the root, near child first, far children on a stack (Havran 2000, "Heuristic ray shooting
// algorithms", appendix C), with leaves tested in blocks.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/standard.cpp"

#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

#include "kernels/tree_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {
namespace {

const EntryPoints& standard() { return entry_points<TreeKernel<StackWalk>>(); }

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
UMBRIX_DEFINE_KERNEL(kStandardKernel, standard, "standard", "stack walk from the root, near child first", nullptr)
#endif
