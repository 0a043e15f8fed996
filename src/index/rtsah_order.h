// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "index/child_order.h"
#include "umbrix/executor.h"

namespace umbrix::detail {

/// The order with the smaller expected cost of an occlusion query. Throws std::bad_alloc.
std::unique_ptr<ChildOrder> make_rtsah_order(const Tree& tree, const Executor* executor);

}  // namespace umbrix::detail
