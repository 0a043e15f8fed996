// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace umbrix::app {

/// Of a frame, in pixels.
struct Size {
  int width = 0, height = 0;
};

}  // namespace umbrix::app
