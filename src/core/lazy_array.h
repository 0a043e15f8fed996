// SPDX-License-Identifier: Apache-2.0
#pragma once

#if defined(__linux__)
#include <sys/mman.h>
#endif

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>

namespace umbrix::detail {

/// What elements are at first. Memory that was used before costs time to clear.
enum class Fill { zeros, nothing };

/// A fixed number of elements, all zero bytes at first unless told otherwise, whose memory the system gives only where
/// it is used: room can be reserved for the worst case. Throws std::bad_alloc.
template <class T>
class LazyArray {
  static_assert(std::is_trivially_destructible_v<T>);

 public:
  LazyArray() = default;
  explicit LazyArray(std::size_t size, Fill fill = Fill::zeros) : size_(size) {
    // calloc, since it leaves fresh pages untouched.
    memory_.reset(fill == Fill::zeros ? std::calloc(size + 1, sizeof(T)) : std::malloc((size + 1) * sizeof(T)));
    if (!memory_ && size > 0) throw std::bad_alloc();
    const auto address = reinterpret_cast<std::uintptr_t>(memory_.get());
    data_ = reinterpret_cast<T*>((address + alignof(T) - 1) / alignof(T) * alignof(T));
    prefer_large_pages();
  }

  std::size_t size() const noexcept { return size_; }
  T* data() const noexcept { return data_; }
  T& operator[](std::size_t i) const noexcept { return data_[i]; }

 private:
  struct Free {
    void operator()(void* p) const noexcept { std::free(p); }
  };

  /// What is used in no order wants few pages to look up. A wish only: nothing depends on it.
  void prefer_large_pages() noexcept {
#if defined(__linux__)
    constexpr std::uintptr_t kPage = 4096;
    constexpr std::size_t kWorthIt = std::size_t{2} << 20;
    const auto begin = (reinterpret_cast<std::uintptr_t>(data_) + kPage - 1) / kPage * kPage;
    const auto end = reinterpret_cast<std::uintptr_t>(data_ + size_) / kPage * kPage;
    if (end > begin + kWorthIt) (void)madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
#endif
  }

  std::unique_ptr<void, Free> memory_;
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace umbrix::detail
