// SPDX-License-Identifier: Apache-2.0
// The child first that costs the training rays less (Feltman, Lee & Fatahalian 2012), on the tree that all kernels
// walk.

#include "index/srdh_order.h"

#include "kernels/ordered.h"
#include "kernels/training.h"

namespace umbrix::detail {
namespace {

/// Nothing without rays to learn from: the walk is then that of "standard".
std::unique_ptr<SideTable> make(const PrepareInput& input) {
  const TrainingRays training = gather_blockers(input);
  if (training.rays.empty()) return nullptr;
  return make_srdh_order(*input.scene.tree, training, input.training.executor);
}

}  // namespace

extern const Kernel kSrdhOrderKernel;
const Kernel kSrdhOrderKernel = {
    {"srdh-order", "the child first that costs the training rays less", true}, &ordered_entry_points, &make};

}  // namespace umbrix::detail
