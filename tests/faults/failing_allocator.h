// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace umbrix {

/// While it lives, the n-th request for memory in this process fails, and with `all_after` all that follow it. What
/// oneTBB asks for is not counted: it has its own way to the system.
class FailingAllocator {
 public:
  FailingAllocator(std::uint64_t n, bool all_after) noexcept;
  ~FailingAllocator();
  FailingAllocator(const FailingAllocator&) = delete;
  FailingAllocator& operator=(const FailingAllocator&) = delete;

  /// Requests so far.
  static std::uint64_t requests() noexcept;
};

}  // namespace umbrix
