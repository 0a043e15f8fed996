// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "index/child_order.h"
#include "index/training_rays.h"
#include "umbrix/executor.h"

namespace umbrix::detail {

/// The order with the smaller cost for the training rays. Throws std::bad_alloc.
std::unique_ptr<ChildOrder> make_srdh_order(const Tree& tree, const TrainingRays& training, const Executor* executor);

}  // namespace umbrix::detail
