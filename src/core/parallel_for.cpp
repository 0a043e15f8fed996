// SPDX-License-Identifier: Apache-2.0
#include "core/parallel_for.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <exception>
#include <mutex>
#include <thread>

#include "core/threads_executor.h"

namespace umbrix::detail {
namespace {

/// Exceptions must not cross a host's executor, which may be written in another language.
struct GuardedBody {
  const std::function<void(std::size_t)>& body;
  std::exception_ptr first;
  std::mutex mutex;

  static void call(void* data, std::size_t index) {
    auto& self = *static_cast<GuardedBody*>(data);
    try {
      self.body(index);
    } catch (...) {
      const std::lock_guard lock(self.mutex);
      if (!self.first) self.first = std::current_exception();
    }
  }
};

}  // namespace

void parallel_for(const Executor* executor, std::size_t count, const std::function<void(std::size_t)>& body) {
#ifdef UMBRIX_THREAD_SANITIZER
  if (!executor || !executor->parallel_for) executor = &threads_executor();
#endif
  if (!executor || !executor->parallel_for) {
    tbb::parallel_for(std::size_t{0}, count, body);
    return;
  }
  GuardedBody guarded{body, nullptr, {}};
  executor->parallel_for(executor->context, count, &GuardedBody::call, &guarded);
  if (guarded.first) std::rethrow_exception(guarded.first);
}

std::size_t thread_count(const Executor* executor) noexcept {
  if (executor && executor->threads != 0) return executor->threads;
  const bool is_tbb = !executor || !executor->parallel_for;
  const auto count = is_tbb ? static_cast<unsigned>(std::max(1, tbb::this_task_arena::max_concurrency()))
                            : std::thread::hardware_concurrency();
  return std::max(1u, count);
}

Status parallel_failure(const char* who, const Executor* executor, const std::exception& error) noexcept try {
  if (executor && executor->parallel_for)
    return {StatusCode::internal, std::string(who) + ": the executor failed: " + error.what()};
  return {StatusCode::resource_limit, std::string(who) + ": no threads: " + error.what()};
} catch (const std::bad_alloc&) {
  return Status::out_of_memory("no threads");
}

}  // namespace umbrix::detail
