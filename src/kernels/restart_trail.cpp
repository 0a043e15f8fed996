// SPDX-License-Identifier: Apache-2.0
// No stack but one bit for each level: set if the far child has been taken there, or if only one is crossed (Laine
// 2010, "Restart trail for stackless BVH traversal"). Adding one at a leaf's level turns the trail into that of the
// next leaf. A restart repeats the same comparisons from the root, so the leaves and their intervals are those of the
// stack walk.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/restart_trail.cpp"

#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

#include "kernels/tree_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {
namespace {

/// The root's bit. Each level below has the next lower one; the bit above says that the walk is over.
constexpr std::uint64_t kRootLevel = std::uint64_t{1} << 61;
static_assert((kRootLevel >> kMaxDepth) != 0, "a bit for every level");

struct RestartTrailWalk {
  using State = NoState;
  static constexpr bool kNearFirst = true;

  template <class Leaf, class Counts>
  static HWY_INLINE bool walk(const SceneView& scene, State&, const WalkRay& ray, const float& limit, Leaf&& leaf,
                              Counts& counts) {
    const Interval root = clip_to_root(ray, *scene.tree);
    if (!(root.t0 <= root.t1)) return false;
    const Node* const nodes = scene.tree->nodes.data();
    std::uint64_t trail = 0;
    for (;;) {
      // Follow the trail, and set its bits where only one child is crossed.
      Interval at = root;
      std::uint64_t level = kRootLevel;
      Node node = nodes[0];
      counts.node();
      for (; !node.is_leaf(); level >>= 1) {
        const std::uint32_t axis = node.axis_bits();
        const float t = plane_time(ray, node.plane(), axis);
        std::uint32_t index = node.low_child() + ray.far_low[axis];
        if (t >= at.t1) {
          trail |= level;
        } else if (t <= at.t0) {
          trail |= level;
          index ^= 1u;
        } else if ((trail & level) != 0) {
          at.t0 = t;
          index ^= 1u;
        } else {
          at.t1 = t;
        }
        node = nodes[index];
        counts.node();
      }
      counts.leaf();
      if (node.block_count() != 0 && leaf(node.blocks(), at.t0, at.t1)) return true;
      // To the lowest far child that is left.
      trail += level << 1;
      if (trail >= kRootLevel << 1 || at.t1 > limit) return false;
      counts.restart();
    }
  }
};

const EntryPoints& restart_trail() { return entry_points<TreeKernel<RestartTrailWalk>>(); }

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
UMBRIX_DEFINE_KERNEL(kRestartTrailKernel, restart_trail, "restart-trail",
                     "no stack but one bit a level: from the root again after each leaf", nullptr)
#endif
