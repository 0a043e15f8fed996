// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "umbrix/ray.h"

namespace umbrix::bench {

/// Asks in the order in which the rays' common end sees their starts: a counting sort by cells of the six faces of a
/// cube around it, the rays and answers copied there and back. What a host could do for any tracer; memory is kept.
class LightOrder {
 public:
  void ask(RaySpan rays, std::uint8_t* out, const std::function<void(RaySpan, std::uint8_t*)>& ask);

 private:
  std::vector<std::uint32_t> cells_, ends_, places_;
  std::vector<Ray> sorted_;
  std::vector<std::uint8_t> answers_;
};

}  // namespace umbrix::bench
