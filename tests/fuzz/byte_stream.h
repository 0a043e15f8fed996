// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace umbrix::fuzz {

/// Values from a fuzzer's bytes, from the front; zeros once they are used up. (libFuzzer has such a class, but only
/// Clang brings it, and other compilers replay the corpus.)
class ByteStream {
 public:
  ByteStream(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  template <class T>
  T take() {
    T value{};
    const std::size_t bytes = sizeof value < size_ ? sizeof value : size_;
    if (bytes > 0) std::memcpy(&value, data_, bytes);
    data_ += bytes;
    size_ -= bytes;
    return value;
  }

  /// From 0 to below `limit`, which must not be 0.
  std::size_t below(std::size_t limit) {
    return limit <= 256 ? take<std::uint8_t>() % limit : take<std::uint32_t>() % limit;
  }

  template <class T, std::size_t N>
  const T& one_of(const T (&values)[N]) {
    return values[below(N)];
  }

  bool chance(std::size_t one_in) { return below(one_in) == 1; }

  bool empty() const { return size_ == 0; }
  std::size_t left() const { return size_; }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
};

}  // namespace umbrix::fuzz
