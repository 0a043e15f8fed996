// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>
#include <vector>

namespace umbrix::detail {

/// Elements of no value at first, whose number grows and which never move: growing touches none of them.
template <class T>
class ChunkedArray {
  static_assert(std::is_trivial_v<T> && alignof(T) <= 64);

 public:
  /// Room for at least so many. Throws std::bad_alloc.
  void grow(std::size_t size) {
    while (capacity() < size) {
      chunks_.reserve(chunks_.size() + 1);
      T* const chunk = static_cast<T*>(std::aligned_alloc(kAlignment, kBytes));
      if (!chunk) throw std::bad_alloc();
      chunks_.emplace_back(chunk);
    }
  }
  std::size_t capacity() const noexcept { return chunks_.size() * kChunk; }
  T& operator[](std::size_t i) noexcept { return chunks_[i / kChunk].get()[i % kChunk]; }

 private:
  static constexpr std::size_t kChunk = 256;
  static constexpr std::size_t kAlignment = 64;
  static constexpr std::size_t kBytes = (kChunk * sizeof(T) + kAlignment - 1) / kAlignment * kAlignment;

  struct Free {
    void operator()(T* p) const noexcept { std::free(p); }
  };
  std::vector<std::unique_ptr<T, Free>> chunks_;
};

}  // namespace umbrix::detail
