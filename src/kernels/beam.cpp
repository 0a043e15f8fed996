// SPDX-License-Identifier: Apache-2.0
// Groups of rays that come one after the other share one walk: see beam-inl.h. A group whose list is long is cut in two
// where its starts are widest apart, and each half picks its leaves from the list of the whole.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/beam.cpp"

#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

#include "kernels/group-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {
namespace {

const EntryPoints& beam() { return group_entry_points(); }

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace umbrix::detail {
namespace {

std::unique_ptr<SideTable> make_beam(const PrepareInput& input) {
  return std::make_unique<WideTree>(*input.scene.tree, input.scene.triangles);
}

}  // namespace
}  // namespace umbrix::detail
UMBRIX_DEFINE_KERNEL(kBeamKernel, beam, "beam", "one walk for a group of rays, which then pick their leaves", make_beam)
#endif
