// SPDX-License-Identifier: Apache-2.0
// Rays of a call in blocks, for threads to take.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <vector>

#include "core/parallel_for.h"
#include "umbrix/scene.h"

namespace umbrix::detail {

/// Of so many rays that are left, how many a thread takes next: less and less, so that all end at about the same time
/// (guided self-scheduling, Polychronopoulos & Kuck 1987).
inline std::size_t block_size(std::size_t left, std::size_t threads, std::size_t fewest, std::size_t most) {
  constexpr std::size_t kTogether = 256;  // a tile
  return std::min(left, std::clamp(left / (3 * threads), fewest, most) / kTogether * kTogether);
}

/// Blocks of a call's rays, which threads take one after the other.
class RayBlocks {
 public:
  struct Block {
    std::size_t begin, end;
  };

  /// For one thread all but the last are as large as may be.
  RayBlocks(std::size_t rays, std::size_t threads, std::size_t fewest, std::size_t most) : begins_{0} {
    for (std::size_t left = rays; left > 0; left = rays - begins_.back()) {
      const std::size_t alone = left < 2 * most ? left : most;
      begins_.push_back(begins_.back() + (threads == 1 ? alone : block_size(left, threads, fewest, most)));
    }
  }

  /// False if there is none left.
  bool take(Block& block) noexcept {
    const std::size_t i = next_.fetch_add(1, std::memory_order_relaxed);
    if (i + 1 >= begins_.size()) return false;
    block = {begins_[i], begins_[i + 1]};
    return true;
  }

 private:
  std::vector<std::size_t> begins_;
  std::atomic<std::size_t> next_{0};
};

/// Calls each(part, first, options) for blocks of the rays on the options' executor, or once for all on this thread if
/// there is none or it fails; `options` are then the block's, without the executor.
template <class Each>
void for_blocks(RaySpan rays, const QueryOptions& options, const Each& each) {
  constexpr std::size_t kFewest = 1u << 12, kMost = 1u << 17;
  const auto ask = [&](std::size_t first, std::size_t count) {
    QueryOptions here = options;
    here.executor = nullptr;
    if (here.skip) here.skip += first;
    each(RaySpan{count > 0 ? &rays[first] : nullptr, count, rays.stride}, first, here);
  };
  if (options.executor && rays.count > kFewest) {
    try {
      const std::size_t threads = std::min(thread_count(options.executor), rays.count / kFewest);
      RayBlocks blocks(rays.count, threads, kFewest, kMost);
      parallel_for(options.executor, threads, [&](std::size_t) {
        for (RayBlocks::Block block; blocks.take(block);) ask(block.begin, block.end - block.begin);
      });
      return;
    } catch (...) {  // no threads, or a host's that fail
    }
  }
  ask(0, rays.count);
}

}  // namespace umbrix::detail
