// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

#include "umbrix/executor.h"

namespace umbrix::detail {

/// Calls body(i) for i < count on the executor (null: oneTBB). The first exception is rethrown here, after all calls.
void parallel_for(const Executor* executor, std::size_t count, const std::function<void(std::size_t)>& body);

}  // namespace umbrix::detail
