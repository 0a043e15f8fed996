// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include "report.h"
#include "umbrix/ray.h"

namespace umbrix::bench {

using Ask = std::function<void(RaySpan, std::uint8_t*)>;

/// Processor time of this thread, or where several threads work the wall time.
inline double seconds_of(int threads) { return threads == 1 ? thread_seconds() : wall_seconds(); }

/// Asks for all rays: on one thread in one call, on more within their arena in equal parts.
inline void ask_all(const Ask& ask, const std::vector<Ray>& rays, std::uint8_t* out, int threads) {
  if (threads == 1) {
    ask({rays.data(), rays.size()}, out);
    return;
  }
  const auto parts = static_cast<std::size_t>(threads);
  const std::size_t block_size = std::max<std::size_t>(4096, (rays.size() + parts - 1) / parts);
  tbb::parallel_for(std::size_t{0}, (rays.size() + block_size - 1) / block_size, [&](std::size_t block) {
    const std::size_t begin = block * block_size;
    ask({rays.data() + begin, std::min(block_size, rays.size() - begin)}, out + begin);
  });
}

}  // namespace umbrix::bench
