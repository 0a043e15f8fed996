// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>

#include "core/large_pages.h"

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
    prefer_large_pages(data_, size * sizeof(T));
  }

  std::size_t size() const noexcept { return size_; }
  T* data() const noexcept { return data_; }
  T& operator[](std::size_t i) const noexcept { return data_[i]; }

 private:
  struct Free {
    void operator()(void* p) const noexcept { std::free(p); }
  };

  std::unique_ptr<void, Free> memory_;
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace umbrix::detail
