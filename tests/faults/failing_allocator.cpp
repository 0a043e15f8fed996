// SPDX-License-Identifier: Apache-2.0
// Replaces operator new, and calloc by the linker (--wrap), since tables that grow in place take that.
#include "failing_allocator.h"

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::uint64_t> seen{0};
std::atomic<std::uint64_t> failing{0};  ///< 0: none
std::atomic<bool> fails_on{false};
std::atomic<std::int64_t> living{0};

bool fails() noexcept {
  const std::uint64_t n = failing;
  if (n == 0) return false;
  const std::uint64_t request = ++seen;
  return request == n || (request > n && fails_on);
}

void* allocate(std::size_t size, std::size_t alignment) {
  if (fails()) throw std::bad_alloc();
  void* memory = nullptr;
  if (posix_memalign(&memory, alignment, size > 0 ? size : 1) != 0) throw std::bad_alloc();
  ++living;
  return memory;
}

void* allocate_or_null(std::size_t size) noexcept {
  try {
    return allocate(size, alignof(std::max_align_t));
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}

void release(void* memory) noexcept {
  living -= memory ? 1 : 0;
  std::free(memory);
}

}  // namespace

namespace umbrix {

FailingAllocator::FailingAllocator(std::uint64_t n, bool all_after) noexcept {
  seen = 0;
  fails_on = all_after;
  failing = n;
}
FailingAllocator::~FailingAllocator() { failing = 0; }

std::uint64_t FailingAllocator::requests() noexcept { return seen; }
std::int64_t FailingAllocator::live() noexcept { return living; }

}  // namespace umbrix

void* operator new(std::size_t size) { return allocate(size, alignof(std::max_align_t)); }
void* operator new[](std::size_t size) { return allocate(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return allocate_or_null(size); }
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept { return allocate_or_null(size); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate(size, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return allocate(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { release(memory); }
void operator delete[](void* memory) noexcept { release(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { release(memory); }
void operator delete[](void* memory, const std::nothrow_t&) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }
void operator delete[](void* memory, std::size_t) noexcept { release(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { release(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { release(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { release(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { release(memory); }

extern "C" {
void* __real_calloc(std::size_t count, std::size_t size);
void* __wrap_calloc(std::size_t count, std::size_t size) { return fails() ? nullptr : __real_calloc(count, size); }
}
