// SPDX-License-Identifier: Apache-2.0
// The counters of the shadow ray distribution heuristic (Feltman, Lee & Fatahalian 2012, "SRDH: specializing BVH
// construction and traversal order using representative shadow ray sets") on a tree that stands: for a ray that crosses
// both children of a node, a child costs its number of triangles, and
//   blockers in the low child only:   high first costs the high child for nothing;
//   blockers in the high child only:  low first costs the low child for nothing;
//   blockers in both:                 each order costs the child that it takes first.
// Rays without blockers visit both in any order.
#include "index/srdh_order.h"

#include <algorithm>
#include <atomic>

#include "core/lazy_array.h"
#include "core/parallel_for.h"
#include "index/subtree_measures.h"

namespace umbrix::detail {
namespace {

/// Rays that meet a child for nothing, or to be stopped, if it goes first.
struct ExtraVisits {
  std::atomic<std::uint32_t> low, high;
};

/// One ray on its way through the tree, with no order and no end at the first blocker.
class Counter {
 public:
  Counter(const Tree& tree, const TrainingRays& training, const TrainingRay& ray, LazyArray<ExtraVisits>& extra)
      : tree_(tree), training_(training), ray_(ray), extra_(extra) {}

  /// Does a leaf that the ray crosses below the node hold a blocker?
  bool visit(std::uint32_t index, float t0, float t1) const {
    const Node& node = tree_.nodes[index];
    if (node.is_leaf()) return holds_blocker(node);
    const std::uint32_t axis = node.axis_bits();
    const float t = (node.plane() - ray_.origin[axis]) * ray_.inverse[axis];
    const bool low_is_near = ray_.inverse[axis] > 0;
    const std::uint32_t near = node.low_child() + (low_is_near ? 0 : 1);
    if (t >= t1) return visit(near, t0, t1);
    if (t <= t0) return visit(near ^ 1u, t0, t1);
    const bool in_near = visit(near, t0, t);
    const bool in_far = visit(near ^ 1u, t, t1);
    const bool in_low = low_is_near ? in_near : in_far;
    const bool in_high = low_is_near ? in_far : in_near;
    if (in_high) extra_[index].low.fetch_add(1, std::memory_order_relaxed);
    if (in_low) extra_[index].high.fetch_add(1, std::memory_order_relaxed);
    return in_low || in_high;
  }

 private:
  bool holds_blocker(const Node& leaf) const {
    const std::uint32_t* const begin = training_.begin_blockers(ray_);
    const std::uint32_t* const end = training_.end_blockers(ray_);
    for (std::uint32_t b = 0; b < leaf.block_count(); ++b) {
      const Block& block = tree_.blocks[leaf.first_block() + b];
      for (std::uint32_t lane = 0; lane < block.count; ++lane)
        if (std::binary_search(begin, end, block.id[lane])) return true;
    }
    return false;
  }

  const Tree& tree_;
  const TrainingRays& training_;
  const TrainingRay& ray_;
  LazyArray<ExtraVisits>& extra_;
};

}  // namespace

std::unique_ptr<ChildOrder> make_srdh_order(const Tree& tree, const TrainingRays& training, const Executor* executor) {
  LazyArray<ExtraVisits> extra(tree.nodes.size());
  constexpr std::size_t kRaysPerTask = 1024;
  const std::size_t count = training.rays.size();
  parallel_for(executor, (count + kRaysPerTask - 1) / kRaysPerTask, [&](std::size_t task) {
    for (std::size_t i = task * kRaysPerTask; i < std::min(count, (task + 1) * kRaysPerTask); ++i) {
      const TrainingRay& ray = training.rays[i];
      if (ray.blocker_count > 0) Counter(tree, training, ray, extra).visit(0, ray.t0, ray.t1);
    }
  });
  const std::vector<double> triangles = triangle_counts(tree);
  // An empty child is a step as well.
  const auto cost = [&](std::uint32_t extra_visits, std::uint32_t child) {
    return static_cast<double>(extra_visits) * std::max(1.0, triangles[child]);
  };
  auto order = std::make_unique<ChildOrder>(tree);
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
    const Node& node = tree.nodes[i];
    if (node.is_leaf()) continue;
    const std::uint32_t low = node.low_child();
    if (cost(extra[i].high, low + 1) < cost(extra[i].low, low)) order->set_high_first(i);
  }
  return order;
}

}  // namespace umbrix::detail
