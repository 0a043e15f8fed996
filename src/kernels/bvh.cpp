// SPDX-License-Identifier: Apache-2.0
// Each ray by itself in the hierarchy of boxes, which a scene always has: see bvh_kernel-inl.h.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/bvh.cpp"

#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

#include "kernels/bvh_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {
namespace {

const EntryPoints& bvh() { return entry_points<BvhKernel>(); }

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
UMBRIX_DEFINE_TREELESS_KERNEL(kBvhKernel, bvh, "bvh",
                              "one ray in the hierarchy of boxes, near boxes first: needs no tree", nullptr)
#endif
