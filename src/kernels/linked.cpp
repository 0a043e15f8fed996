// SPDX-License-Identifier: Apache-2.0
// Links made by the first ray that wants one: the on-demand links of Liang & Huang (2019) without a search from the
// lights beforehand.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/linked.cpp"

#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

#include "kernels/link_walk-inl.h"
#include "kernels/tree_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {
namespace {

const EntryPoints& linked() { return entry_points<TreeKernel<LinkWalk>>(); }

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace umbrix::detail {
namespace {

std::unique_ptr<SideTable> make_lazy_links(const PrepareInput& input) {
  return std::make_unique<Links>(*input.scene.tree, LinkBuilder::lazy);
}

}  // namespace
}  // namespace umbrix::detail
UMBRIX_DEFINE_KERNEL(kLinkedKernel, linked, "linked", "from leaf to leaf by links that rays make as they want them",
                     make_lazy_links)
#endif
