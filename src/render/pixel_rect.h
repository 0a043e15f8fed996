// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace umbrix::render {

/// A rectangle of pixels.
struct PixelRect {
  int x = 0, y = 0, width = 0, height = 0;

  std::size_t size() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

}  // namespace umbrix::render
