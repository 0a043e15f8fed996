// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>

namespace umbrix::detail {

/// Like a std::vector of plain elements; but a long one grows without a copy where the system can move its pages, and
/// room that is not used yet takes none.
template <class T>
class GrowingArray {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

 public:
  /// Makes room for `count` more, growing geometrically. Throws std::bad_alloc.
  void make_room(std::size_t count) {
    if (capacity_ - size_ >= count) return;
    const std::size_t capacity = std::max(size_ + count, (capacity_ < kFast ? 4 : 2) * capacity_);
    void* const grown = std::realloc(data_.get(), capacity * sizeof(T));
    if (!grown) throw std::bad_alloc();
    (void)data_.release();  // freed, or the same
    data_.reset(static_cast<T*>(grown));
    capacity_ = capacity;
  }
  /// There must be room.
  void push_back(const T& value) noexcept { data_.get()[size_++] = value; }
  void append(std::size_t count, const T& value) noexcept {
    std::fill_n(data_.get() + size_, count, value);
    size_ += count;
  }

  const T* data() const noexcept { return data_.get(); }
  std::size_t size() const noexcept { return size_; }
  bool empty() const noexcept { return size_ == 0; }
  const T& operator[](std::size_t i) const noexcept { return data_.get()[i]; }
  const T& back() const noexcept { return data_.get()[size_ - 1]; }

 private:
  struct Free {
    void operator()(T* p) const noexcept { std::free(p); }
  };

  static constexpr std::size_t kFast = (std::size_t{16} << 20) / sizeof(T);

  std::unique_ptr<T, Free> data_;
  std::size_t size_ = 0, capacity_ = 0;
};

}  // namespace umbrix::detail
