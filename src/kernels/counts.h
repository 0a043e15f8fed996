// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "tree/tree.h"
#include "umbrix/stats.h"

namespace umbrix::detail {

/// The observer of an uncounted query: compiles to nothing. `blocked_by` says which block and lane ended the
/// ray, for observers that learn, and returns true.
struct NoCounts {
  void node() noexcept {}
  void leaf() noexcept {}
  void primitives(std::uint32_t) noexcept {}
  void indexed(std::uint32_t) noexcept {}
  void double_test() noexcept {}
  void exact_test() noexcept {}
  void invalid_ray() noexcept {}
  void far_ray() noexcept {}
  void link() noexcept {}
  void missing_link() noexcept {}
  void restart() noexcept {}
  bool blocked_by(const Block&, std::uint32_t) noexcept { return true; }
};

/// The observer of a counted query, for one ray.
struct CountEach {
  RayCounts counts;

  CountEach() noexcept { counts.rays = 1; }
  void node() noexcept { ++counts.node_tests; }
  void leaf() noexcept { ++counts.leaf_visits; }
  void primitives(std::uint32_t n) noexcept { counts.primitive_tests += n; }
  void indexed(std::uint32_t n) noexcept { counts.index_tests += n; }
  void double_test() noexcept { ++counts.double_tests; }
  void exact_test() noexcept { ++counts.exact_tests; }
  void invalid_ray() noexcept { ++counts.invalid_rays; }
  void far_ray() noexcept { ++counts.far_rays; }
  void link() noexcept { ++counts.links_followed; }
  void missing_link() noexcept { ++counts.links_missing; }
  void restart() noexcept { ++counts.restarts; }
  bool blocked_by(const Block&, std::uint32_t) noexcept { return true; }

  /// Adds more work for the same ray.
  void add(const CountEach& more) noexcept {
    counts += more.counts;
    counts.rays = 1;
  }
};

}  // namespace umbrix::detail
