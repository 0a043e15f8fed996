// SPDX-License-Identifier: Apache-2.0
// The child first that makes the smaller expected cost of an occlusion query (Ize & Hansen 2011).

#include "index/rtsah_order.h"
#include "kernels/ordered.h"

namespace umbrix::detail {
namespace {

std::unique_ptr<SideTable> make(const PrepareInput& input) {
  return make_rtsah_order(*input.scene.tree, input.training.executor);
}

}  // namespace

extern const Kernel kRtsahKernel;
const Kernel kRtsahKernel = {
    {"rtsah", "the child first that lets an occluded ray end sooner", true}, &ordered_entry_points, &make};

}  // namespace umbrix::detail
