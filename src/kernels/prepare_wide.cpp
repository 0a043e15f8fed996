// SPDX-License-Identifier: Apache-2.0
#include "index/wide_tree.h"
#include "kernels/kernel.h"

namespace umbrix::detail {

std::unique_ptr<SideTable> make_wide_tree(const PrepareInput& input) {
  return std::make_unique<WideTree>(*input.scene.tree, input.scene.triangles);
}

}  // namespace umbrix::detail
