// SPDX-License-Identifier: Apache-2.0
#include "core/threads_executor.h"

#include <atomic>
#include <thread>
#include <vector>

namespace umbrix::detail {
namespace {

constexpr std::size_t kThreads = 3;

thread_local bool within_loop = false;

void run(void*, std::size_t count, void (*body)(void*, std::size_t), void* data) {
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    const bool was_within = within_loop;
    within_loop = true;
    for (std::size_t i; (i = next.fetch_add(1)) < count;) body(data, i);
    within_loop = was_within;
  };
  std::vector<std::thread> workers;
  for (std::size_t t = 1; t < kThreads && t < count && !within_loop; ++t) workers.emplace_back(work);
  work();
  for (std::thread& worker : workers) worker.join();
}

}  // namespace

const Executor& threads_executor() noexcept {
  static const Executor executor = {&run, nullptr, kThreads};
  return executor;
}

}  // namespace umbrix::detail
