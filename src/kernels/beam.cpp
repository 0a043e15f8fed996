// SPDX-License-Identifier: Apache-2.0
// Groups of rays that share a walk: see group-inl.h.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/beam.cpp"

#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

#include "kernels/batch-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {
namespace {

const EntryPoints& beam_entry_points() { return batch_entry_points<false>(); }

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
UMBRIX_DEFINE_KERNEL(kBeamKernel, beam_entry_points, "beam",
                     "one walk for a group of rays, which then pick their leaves", make_wide_tree)
#endif
