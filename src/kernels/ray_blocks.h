// SPDX-License-Identifier: Apache-2.0
// Rays of a call in blocks, for threads to take.
#pragma once

#include <algorithm>
#include <cstddef>

#include "core/parallel_for.h"
#include "umbrix/scene.h"

namespace umbrix::detail {

/// Calls each(part, first, options) for blocks of the rays on the options' executor, or once for all on this thread if
/// there is none or it fails; `options` are then the block's, without the executor.
template <class Each>
void for_blocks(RaySpan rays, const QueryOptions& options, const Each& each) {
  // Some for each thread, as some cost more; within a block rays still share what they can.
  constexpr std::size_t kOfThread = 16, kFewest = 1u << 12, kMost = 1u << 17, kTogether = 256;
  const auto ask = [&](RaySpan part, std::size_t first) {
    QueryOptions here = options;
    here.executor = nullptr;
    if (here.skip) here.skip += first;
    each(part, first, here);
  };
  if (options.executor && rays.count > kFewest) {
    const std::size_t share = rays.count / (kOfThread * thread_count(options.executor));
    const std::size_t size = std::clamp(share, kFewest, kMost) / kTogether * kTogether;
    try {
      parallel_for(options.executor, (rays.count + size - 1) / size, [&](std::size_t block) {
        const std::size_t first = block * size;
        ask({&rays[first], std::min(size, rays.count - first), rays.stride}, first);
      });
      return;
    } catch (...) {  // no threads, or a host's that fail
    }
  }
  ask(rays, 0);
}

}  // namespace umbrix::detail
