// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <vector>

#include "core/array_view.h"
#include "tree/tree.h"
#include "umbrix/executor.h"
#include "umbrix/scene.h"

namespace umbrix::detail {

/// A tree whose box, scale and eps are there from the start, and whose nodes are made when something first needs them.
/// Any threads: what was made is never changed.
class LazyTree {
 public:
  LazyTree(ArrayView<Triangle> triangles, ArrayView<std::uint32_t> kept, const Box& bounds, BuildQuality quality);

  const Tree& tree() const noexcept { return tree_; }
  bool is_built() const noexcept { return state_.load(std::memory_order_acquire) == State::built; }

  /// Builds what is not built. Throws what build_tree throws; may then be called again.
  void build(const Executor* executor) const;

  /// The same within a query, by oneTBB. False if that failed, then and in later queries.
  bool need() const noexcept;

  /// For queries that can do without, but would rather not: true if it is built, or if rays that did without it have
  /// by now cost about as much as it does, and this call has built it. Waits for no other thread.
  bool earn(std::size_t rays) const noexcept;

  /// What commit knew, and with the tree's figures once it is built.
  void set_stats(const BuildStats& stats) { stats_ = stats_with_tree_ = stats; }
  const BuildStats& stats() const noexcept { return is_built() ? stats_with_tree_ : stats_; }

 private:
  enum class State { none, built, failed };

  void build_locked(const Executor* executor) const;
  bool try_build_locked() const noexcept;

  ArrayView<Triangle> triangles_;
  ArrayView<std::uint32_t> kept_;
  BuildQuality quality_;
  mutable Tree tree_;
  BuildStats stats_;
  mutable BuildStats stats_with_tree_;
  mutable std::mutex mutex_;
  mutable std::atomic<State> state_{State::none};
  mutable std::atomic<std::uint64_t> rays_without_{0};
};

}  // namespace umbrix::detail
