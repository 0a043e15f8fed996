// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>
#include <vector>

namespace umbrix::detail {

/// Elements of no value at first, whose number grows and which never move: growing touches none of them.
template <class T, std::size_t kChunk>
class ChunkedArray {
  static_assert(std::is_trivial_v<T> && (kChunk & (kChunk - 1)) == 0);

 public:
  /// Room for at least so many. Throws std::bad_alloc.
  void grow(std::size_t size) {
    while (chunks_.size() * kChunk < size) chunks_.emplace_back(new T[kChunk]);
  }
  std::size_t capacity() const noexcept { return chunks_.size() * kChunk; }
  T& operator[](std::size_t i) noexcept { return chunks_[i / kChunk][i % kChunk]; }

 private:
  std::vector<std::unique_ptr<T[]>> chunks_;
};

}  // namespace umbrix::detail
