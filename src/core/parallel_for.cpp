// SPDX-License-Identifier: Apache-2.0
#include "core/parallel_for.h"

#include <tbb/parallel_for.h>

#include <exception>
#include <mutex>

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
  if (!executor || !executor->parallel_for) {
    tbb::parallel_for(std::size_t{0}, count, body);
    return;
  }
  GuardedBody guarded{body, nullptr, {}};
  executor->parallel_for(executor->context, count, &GuardedBody::call, &guarded);
  if (guarded.first) std::rethrow_exception(guarded.first);
}

Status parallel_failure(const char* who, const Executor* executor, const std::exception& error) noexcept try {
  if (executor && executor->parallel_for)
    return {StatusCode::internal, std::string(who) + ": the executor failed: " + error.what()};
  return {StatusCode::resource_limit, std::string(who) + ": no threads: " + error.what()};
} catch (const std::bad_alloc&) {
  return Status::out_of_memory("no threads");
}

}  // namespace umbrix::detail
