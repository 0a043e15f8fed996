// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "umbrix/executor.h"

#if defined(__SANITIZE_THREAD__)
#define UMBRIX_THREAD_SANITIZER
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define UMBRIX_THREAD_SANITIZER
#endif
#endif

namespace umbrix::detail {

/// Runs loops on threads of its own, and loops within loops in place. For the thread sanitizer, which cannot see what
/// orders the tasks of a oneTBB that is not instrumented.
const Executor& threads_executor() noexcept;

}  // namespace umbrix::detail
