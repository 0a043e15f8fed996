// SPDX-License-Identifier: Apache-2.0
// No stack: after each leaf up to the lowest node that the ray has not left, and down again (Foley & Sugerman 2005,
// "KD-tree acceleration structures for a GPU raytracer"). As with links, the ray leaves a cell at the
// first of its exit planes' times, and planes keep their times. So the way down from that node is the one that would
// come from the root.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/kd_backtrack.cpp"

#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

#include <limits>

#include "index/parents.h"
#include "kernels/tree_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {
namespace {

/// When the ray leaves a cell.
HWY_INLINE float exit_time(const float (&faces)[kFaces], const WalkRay& ray) {
  float exit = std::numeric_limits<float>::infinity();
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    const float t = plane_time(ray, faces[face_of(axis, ray.far_low[axis] == 0)], axis);
    exit = t < exit ? t : exit;
  }
  return exit;
}

struct BacktrackWalk {
  struct State {
    const Parents* parents;

    explicit State(const SceneView& scene) : parents(static_cast<const Parents*>(scene.side)) {}
  };
  static constexpr bool kNearFirst = true;

  template <class Leaf, class Counts>
  static HWY_INLINE bool walk(const SceneView& scene, State& state, const WalkRay& ray, const float& limit, Leaf&& leaf,
                              Counts& counts) {
    Interval at = clip_to_root(ray, *scene.tree);
    if (!(at.t0 <= at.t1)) return false;
    if (HWY_UNLIKELY(!state.parents)) return stack_walk(*scene.tree, 0, at, ray, limit, leaf, counts);
    const Node* const nodes = scene.tree->nodes.data();
    const float end = at.t1;
    std::uint32_t index = 0;
    for (;;) {
      // Descend to the leaf at the start of the interval.
      Node node = nodes[index];
      counts.node();
      while (!node.is_leaf()) {
        const std::uint32_t axis = node.axis_bits();
        const float t = plane_time(ray, node.plane(), axis);
        index = node.low_child() + ray.far_low[axis];
        if (!(at.t0 < t)) {
          index ^= 1u;
        } else if (t < at.t1) {
          at.t1 = t;
        }
        node = nodes[index];
        counts.node();
      }
      counts.leaf();
      if (node.block_count() != 0 && leaf(node.blocks(), at.t0, at.t1)) return true;
      if (!(at.t1 < end)) return false;
      at.t0 = at.t1;
      if (at.t0 > limit) return false;
      // Up to a node whose cell holds what comes next. The root's holds all.
      counts.restart();
      for (;;) {
        const Parents::Parent& parent = state.parents->of(index);
        const float exit = exit_time(parent.faces, ray);
        index = parent.node;
        if (at.t0 < exit) {
          at.t1 = exit < end ? exit : end;
          break;
        }
        counts.node();
      }
    }
  }
};

const EntryPoints& kd_backtrack() { return entry_points<TreeKernel<BacktrackWalk>>(); }

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace umbrix::detail {
namespace {

std::unique_ptr<SideTable> make_parents(const PrepareInput& input) {
  return std::make_unique<Parents>(*input.scene.tree);
}

}  // namespace
}  // namespace umbrix::detail
UMBRIX_DEFINE_KERNEL(kKdBacktrackKernel, kd_backtrack, "kd-backtrack",
                     "no stack: after each leaf up to the lowest node that holds what comes next", make_parents)
#endif
