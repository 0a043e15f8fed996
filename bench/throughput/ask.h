// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include "report.h"
#include "umbrix/executor.h"
#include "umbrix/ray.h"

namespace umbrix::bench {

using Ask = std::function<void(RaySpan, std::uint8_t*)>;

/// Processor time of this thread, or where several threads work the wall time.
inline double seconds_of(int threads) { return threads == 1 ? thread_seconds() : wall_seconds(); }

/// What Umbrix shares a call among threads with; null for one.
inline const Executor* executor_for(int threads) {
  static constexpr Executor kTbb{};
  return threads > 1 ? &kTbb : nullptr;
}

/// How rays come to several threads.
enum class Cutting {
  none,    ///< all in one call, which shares them itself
  blocks,  ///< 64 tiles in a call: threads take the next as they are ready
  parts,   ///< a call for each thread: what is sorted for the call gains from many
};

/// Asks for all rays within the arena of so many threads; on one thread in one call.
inline void ask_all(const Ask& ask, const std::vector<Ray>& rays, std::uint8_t* out, int threads, Cutting cutting) {
  if (threads == 1 || cutting == Cutting::none) {
    ask({rays.data(), rays.size()}, out);
    return;
  }
  const std::size_t part = (rays.size() + static_cast<std::size_t>(threads) - 1) / static_cast<std::size_t>(threads);
  const std::size_t size = cutting == Cutting::blocks ? 64 * 256 : std::max<std::size_t>(part, 1);
  tbb::parallel_for(std::size_t{0}, (rays.size() + size - 1) / size, [&](std::size_t block) {
    const std::size_t begin = block * size;
    ask({rays.data() + begin, std::min(size, rays.size() - begin)}, out + begin);
  });
}

}  // namespace umbrix::bench
