// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <exception>
#include <functional>

#include "umbrix/executor.h"
#include "umbrix/status.h"

namespace umbrix::detail {

/// Calls body(i) for i < count on the executor (null: oneTBB). The first exception is rethrown here, after all calls.
void parallel_for(const Executor* executor, std::size_t count, const std::function<void(std::size_t)>& body);

/// How many calls of the body may run at once.
std::size_t thread_count(const Executor* executor) noexcept;

/// For what parallel_for threw, unless it is std::bad_alloc: oneTBB does where it can make no thread, for want of
/// memory or by the system's limit; a host's executor fails by itself. `who` begins the message.
Status parallel_failure(const char* who, const Executor* executor, const std::exception& error) noexcept;

}  // namespace umbrix::detail
