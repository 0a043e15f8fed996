// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "index/child_order.h"
#include "umbrix/executor.h"

namespace umbrix::detail {

/// What "larger" may mean of a child.
enum class SatoMeasure {
  tight_box,      ///< the box of what lies in its cell
  triangle_area,  ///< of the parts in its cell
  triangle_count,
  cell,  ///< its cell, unless that is empty
};

/// The larger child first, empty ones last. Throws std::bad_alloc.
std::unique_ptr<ChildOrder> make_sato_order(const Tree& tree, SatoMeasure measure, const Executor* executor);

}  // namespace umbrix::detail
