// SPDX-License-Identifier: Apache-2.0
// The walk over the folded tree: eight boxes at a time, near ones first. A hit lies in the closed interval of some leaf
// of the stack walk (see walk-inl.h); that leaf's cell lies within the cells above it, and since the times of planes
// grow with the planes, so do the intervals. A leaf's box of contents holds the hit with a margin of eps on all sides,
// which covers the rounding of its planes' times.

#if defined(UMBRIX_KERNELS_WIDE_WALK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_WIDE_WALK_INL_H_
#undef UMBRIX_KERNELS_WIDE_WALK_INL_H_
#else
#define UMBRIX_KERNELS_WIDE_WALK_INL_H_
#endif

#include <hwy/highway.h>

#include <utility>

#include "index/wide_tree.h"
#include "kernels/leaf_test-inl.h"
#include "kernels/walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

/// Which of eight boxes a ray crosses, and when.
struct Crossed {
  alignas(32) float t0[kBlockLanes];
  alignas(32) float t1[kBlockLanes];
  std::uint32_t lanes = 0;
};

/// `faces[f]` has the boxes' faces from lane `first` on.
template <class Faces>
HWY_INLINE void cross_boxes(const Faces& faces, std::uint32_t first, const WalkRay& ray, Interval at, Crossed& out) {
  const Lanes8 f;
  out.lanes = 0;
  for (std::uint32_t i = 0; i < kBlockLanes; i += static_cast<std::uint32_t>(hn::Lanes(f))) {
    auto t0 = hn::Set(f, at.t0), t1 = hn::Set(f, at.t1);
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      const bool down = ray.far_low[axis] != 0;
      const auto origin = hn::Set(f, ray.origin[axis]), inverse = hn::Set(f, ray.inverse[axis]);
      const auto entry = hn::Load(f, faces[face_of(axis, down)] + first + i);
      const auto exit = hn::Load(f, faces[face_of(axis, !down)] + first + i);
      t0 = hn::Max(t0, hn::Mul(hn::Sub(entry, origin), inverse));
      t1 = hn::Min(t1, hn::Mul(hn::Sub(exit, origin), inverse));
    }
    out.lanes |= bits_of(hn::Le(t0, t1)) << i;
    hn::Store(t0, f, out.t0 + i);
    hn::Store(t1, f, out.t1 + i);
  }
}

/// Visits the leaves that hold something where the ray is within the interval: leaf(run, t0, t1) returns true to stop.
/// Siblings come near first, but not all leaves do.
template <class Leaf, class Counts>
HWY_INLINE bool wide_walk(const WideTree& tree, Interval at, const WalkRay& ray, Leaf&& leaf, Counts& counts) {
  struct Pending {
    const WideNode* parent;
    std::uint32_t lane;
    float t0;
  };
  // Each level leaves at most seven siblings behind; a level of the wide tree is at least one of the tree.
  Pending stack[7 * kMaxDepth + 8];
  std::uint32_t pending = 0;
  const WideNode* node = &tree.node(0);
  for (;;) {
    counts.node();
    Crossed crossed;
    cross_boxes(node->faces, 0, ray, at, crossed);
    // Leaves at once; inner children onto the stack, the nearest last.
    const std::uint32_t base = pending;
    for (std::uint32_t rest = crossed.lanes; rest != 0; rest &= rest - 1) {
      const auto lane = static_cast<std::uint32_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(rest));
      const WideChild child(node->children[lane].load(std::memory_order_acquire));
      if (child.is_leaf()) {
        counts.node();
        counts.leaf();
        if (leaf(child.run(), crossed.t0[lane], crossed.t1[lane])) return true;
        continue;
      }
      std::uint32_t place = pending++;
      for (; place > base && stack[place - 1].t0 < crossed.t0[lane]; --place) stack[place] = stack[place - 1];
      stack[place] = {node, lane, crossed.t0[lane]};
    }
    if (pending == 0) return false;
    const Pending& next = stack[--pending];
    node = &tree.node(tree.enter(*next.parent, next.lane));
  }
}

/// The walk of kernels that have a WideTree as their side table.
struct WideWalk {
  struct State {
    const WideTree* tree;

    explicit State(const SceneView& scene) : tree(static_cast<const WideTree*>(scene.side)) {}
  };
  static constexpr bool kNearFirst = false;

  template <class Leaf, class Counts>
  static HWY_INLINE bool walk(const SceneView& scene, State& state, const WalkRay& ray, const float& limit, Leaf&& leaf,
                              Counts& counts) {
    const Interval at = clip_to_root(ray, *scene.tree);
    if (!(at.t0 <= at.t1)) return false;
    if (HWY_UNLIKELY(!state.tree)) return stack_walk(*scene.tree, 0, at, ray, limit, leaf, counts);
    return wide_walk(*state.tree, at, ray, leaf, counts);
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
