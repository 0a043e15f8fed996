// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "umbrix/stats.h"

namespace umbrix::detail {

/// The observer of an uncounted query: compiles to nothing.
struct NoCounts {
  void node() noexcept {}
  void leaf() noexcept {}
  void primitives(std::uint32_t) noexcept {}
  void double_test() noexcept {}
  void exact_test() noexcept {}
  void invalid_ray() noexcept {}
  void far_ray() noexcept {}
};

/// The observer of a counted query, for one ray.
struct CountEach {
  RayCounts counts{1, 0, 0, 0, 0, 0, 0, 0};

  void node() noexcept { ++counts.node_tests; }
  void leaf() noexcept { ++counts.leaf_visits; }
  void primitives(std::uint32_t n) noexcept { counts.primitive_tests += n; }
  void double_test() noexcept { ++counts.double_tests; }
  void exact_test() noexcept { ++counts.exact_tests; }
  void invalid_ray() noexcept { ++counts.invalid_rays; }
  void far_ray() noexcept { ++counts.far_rays; }
};

}  // namespace umbrix::detail
