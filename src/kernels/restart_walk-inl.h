// SPDX-License-Identifier: Apache-2.0
// Walks that go on from above, at the time at which they left a leaf, instead of keeping all far children on a stack:
// kd-restart (Foley & Sugerman 2005, "KD-tree acceleration structures for a GPU raytracer"), push-down and short stack
// (Horn, Sugerman, Houston & Hanrahan 2007, "Interactive k-D tree GPU raytracing").
//
// The time of a restart is that of a plane, never of a rounded point. At a node, near is entered if t0 < t(plane) and
// far otherwise, so a leaf's interval ends at the first plane after t0: restarts move forward, and the intervals of the
// leaves follow each other without a gap. A hit at t is therefore in a leaf whose entry planes have times <= t <= those
// of its exit planes, which is all that the stack walk guarantees.

#if defined(UMBRIX_KERNELS_RESTART_WALK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_RESTART_WALK_INL_H_
#undef UMBRIX_KERNELS_RESTART_WALK_INL_H_
#else
#define UMBRIX_KERNELS_RESTART_WALK_INL_H_
#endif

#include <hwy/highway.h>

#include "kernels/walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

struct FarChild {
  std::uint32_t node;
  float t1;
};

/// The last kSize far children put in; a further one takes the place of the oldest.
template <std::uint32_t kSize>
class ShortStack {
 public:
  bool empty() const { return held_ == 0; }
  void push(const FarChild& entry) {
    entries_[next_] = entry;
    next_ = next_ + 1 == kSize ? 0 : next_ + 1;
    held_ = held_ == kSize ? kSize : held_ + 1;
  }
  FarChild pop() {
    next_ = (next_ == 0 ? kSize : next_) - 1;
    --held_;
    return entries_[next_];
  }

 private:
  FarChild entries_[kSize];
  std::uint32_t next_ = 0, held_ = 0;
};

template <>
class ShortStack<0> {
 public:
  bool empty() const { return true; }
  void push(const FarChild&) {}
  FarChild pop() { return {}; }
};

/// With `kPushDown` a restart begins at the lowest node that held all of the rest of the ray.
template <bool kPushDown, std::uint32_t kStackSize>
struct RestartWalk {
  using State = NoState;
  static constexpr bool kNearFirst = true;

  template <class Leaf, class Counts>
  static HWY_INLINE bool walk(const SceneView& scene, State&, const WalkRay& ray, const float& limit, Leaf&& leaf,
                              Counts& counts) {
    Interval at = clip_to_root(ray, *scene.tree);
    if (!(at.t0 <= at.t1)) return false;
    const Node* const nodes = scene.tree->nodes.data();
    const float end = at.t1;
    std::uint32_t top = 0, index = 0;
    bool is_top = kPushDown;
    ShortStack<kStackSize> stack;
    for (;;) {
      // Descend to the leaf at the start of the interval.
      Node node = nodes[index];
      counts.node();
      while (!node.is_leaf()) {
        const std::uint32_t axis = node.axis_bits();
        const float t = plane_time(ray, node.plane(), axis);
        const std::uint32_t near = node.low_child() + ray.far_low[axis];
        if (!(at.t0 < t)) {
          index = near ^ 1u;
        } else {
          index = near;
          if (t < at.t1) {
            stack.push({near ^ 1u, at.t1});
            at.t1 = t;
            is_top = false;
          }
        }
        if (is_top) top = index;
        node = nodes[index];
        counts.node();
      }
      counts.leaf();
      if (node.block_count() != 0 && leaf(node.blocks(), at.t0, at.t1)) return true;
      if (!(at.t1 < end)) return false;
      at.t0 = at.t1;
      if (at.t0 > limit) return false;
      if (!stack.empty()) {
        const FarChild next = stack.pop();
        index = next.node;
        at.t1 = next.t1;
      } else {
        counts.restart();
        index = top;
        at.t1 = end;
        is_top = kPushDown;
      }
    }
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
