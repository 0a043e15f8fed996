// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "index/child_order.h"
#include "umbrix/executor.h"

namespace umbrix::detail {

/// How likely a ray through a leaf is not to be stopped there.
enum class LeafVisibility {
  none,     ///< it always is, unless the leaf is empty
  by_area,  ///< by the leaf's triangles, taken as independent
};

/// The order with the smaller expected cost of an occlusion query. Throws std::bad_alloc.
std::unique_ptr<ChildOrder> make_rtsah_order(const Tree& tree, LeafVisibility leaves, const Executor* executor);

}  // namespace umbrix::detail
