// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace umbrix::detail {

/// Elements that someone else holds, to read.
template <class T>
class ArrayView {
 public:
  /// Of a std::vector or a GrowingArray.
  template <class Array>
  ArrayView(const Array& array) noexcept : data_(array.data()), size_(array.size()) {}

  const T* data() const noexcept { return data_; }
  std::size_t size() const noexcept { return size_; }
  bool empty() const noexcept { return size_ == 0; }
  const T& operator[](std::size_t i) const noexcept { return data_[i]; }
  const T* begin() const noexcept { return data_; }
  const T* end() const noexcept { return data_ + size_; }

 private:
  const T* data_;
  std::size_t size_;
};

}  // namespace umbrix::detail
