// SPDX-License-Identifier: Apache-2.0
#include "tree/lazy_tree.h"

#include <tbb/task_arena.h>

#include <chrono>
#include <exception>

#include "tree/builder.h"

namespace umbrix::detail {
namespace {

/// A ray that walks boxes alone instead of the tree in a group loses 0.03 microseconds; a triangle's share of a build
/// takes some three.
constexpr std::uint64_t kRaysPerTriangle = 100;

}  // namespace

LazyTree::LazyTree(ArrayView<Triangle> triangles, ArrayView<std::uint32_t> kept, const Box& bounds,
                   BuildQuality quality)
    : triangles_(triangles), kept_(kept), quality_(quality), tree_(tree_around(bounds)) {}

void LazyTree::build(const Executor* executor) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!is_built()) build_locked(executor);
}

bool LazyTree::need() const noexcept {
  if (is_built()) return true;
  const std::lock_guard<std::mutex> lock(mutex_);
  return try_build_locked();
}

bool LazyTree::earn(std::size_t rays) const noexcept {
  if (is_built()) return true;
  const std::uint64_t before = rays_without_.fetch_add(rays, std::memory_order_relaxed);
  if (before < kRaysPerTriangle * kept_.size()) return false;
  const std::unique_lock<std::mutex> lock(mutex_, std::try_to_lock);
  return lock.owns_lock() && try_build_locked();
}

bool LazyTree::try_build_locked() const noexcept {
  if (state_.load(std::memory_order_relaxed) == State::none) {
    try {
      // A thread that waits for parts of the build must not take up another query, which would wait for the tree.
      tbb::this_task_arena::isolate([this] { build_locked(nullptr); });
    } catch (const std::exception&) {
      state_.store(State::failed, std::memory_order_relaxed);
    }
  }
  return is_built();
}

void LazyTree::build_locked(const Executor* executor) const {
  const auto start = std::chrono::steady_clock::now();
  BuildStats stats = stats_;
  Tree built = build_tree(triangles_, kept_, quality_, executor, stats);
  stats.bytes += stats.node_bytes + stats.leaf_bytes;
  stats.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  // The rest is the same, and others read it.
  tree_.nodes = std::move(built.nodes);
  tree_.blocks = std::move(built.blocks);
  stats_with_tree_ = stats;
  state_.store(State::built, std::memory_order_release);
}

}  // namespace umbrix::detail
