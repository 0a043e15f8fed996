// SPDX-License-Identifier: Apache-2.0
// Links of all leaves, made before the first ray (Popov, Guenther, Seidel & Slusallek 2007, "Stackless KD-tree
// traversal for high performance GPU ray tracing").

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/ropes.cpp"

#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

#include "kernels/link_walk-inl.h"
#include "kernels/tree_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {
namespace {

const EntryPoints& ropes() { return entry_points<TreeKernel<LinkWalk>>(); }

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace umbrix::detail {
namespace {

std::unique_ptr<SideTable> make_all_links(const PrepareInput& input) {
  auto links = std::make_unique<Links>(*input.scene.tree, LinkBuilder::full);
  links->build_full(input.training.executor);
  return links;
}

}  // namespace
}  // namespace umbrix::detail
UMBRIX_DEFINE_KERNEL(kRopesKernel, ropes, "ropes", "from leaf to leaf by links that are all made before the first ray",
                     make_all_links)
#endif
