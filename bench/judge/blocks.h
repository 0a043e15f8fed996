// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>

namespace umbrix::judge {

inline constexpr std::size_t kBlock = 1024;

/// Calls body(begin, count) for blocks of kBlock of `count` things, over all cores.
template <typename Body>
void for_each_block(std::size_t count, const Body& body) {
  tbb::parallel_for(std::size_t{0}, (count + kBlock - 1) / kBlock, [&](std::size_t block) {
    const std::size_t begin = block * kBlock;
    body(begin, std::min(kBlock, count - begin));
  });
}

}  // namespace umbrix::judge
