// SPDX-License-Identifier: Apache-2.0
// The walk from leaf to leaf by links (Havran 2000; Popov et al. 2007). The next leaf is found by plane times alone,
// never by a rounded point: at time t the ray is in the leaf whose entry planes have times <= t <= those of its exit
// planes, and since the same plane has the same time in every leaf, it goes through cells in the order of the times and
// never back. So the leaves are those of the stack walk, up to cells that are touched in one instant.

#if defined(UMBRIX_KERNELS_LINK_WALK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_LINK_WALK_INL_H_
#undef UMBRIX_KERNELS_LINK_WALK_INL_H_
#else
#define UMBRIX_KERNELS_LINK_WALK_INL_H_
#endif

#include <hwy/highway.h>

#include "index/links.h"
#include "kernels/walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

/// Goes down from a node to the leaf that the ray is in at time t.
template <class Counts>
HWY_INLINE std::uint32_t descend(const Tree& tree, std::uint32_t index, const WalkRay& ray, float t, Counts& counts) {
  const Node* const nodes = tree.nodes.data();
  Node node = nodes[index];
  counts.node();
  while (!node.is_leaf()) {
    const std::uint32_t axis = node.axis_bits();
    const std::uint32_t near = node.low_child() + ray.far_low[axis];
    index = t < plane_time(ray, node.plane(), axis) ? near : near ^ 1u;
    node = nodes[index];
    counts.node();
  }
  return index;
}

/// Is the ray within the leaf at time t, by plane times?
HWY_INLINE bool is_within(const LinkedLeaf& leaf, const WalkRay& ray, float t) {
  bool within = true;
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    const bool down = ray.far_low[axis] != 0;
    const float entry = plane_time(ray, leaf.faces[face_of(axis, down)], axis);
    const float exit = plane_time(ray, leaf.faces[face_of(axis, !down)], axis);
    within &= entry <= t && t < exit;
  }
  return within;
}

/// Where one ray's walk may begin the next one's.
struct LinkStart {
  std::uint32_t record = 0;
};

/// Visits the leaves from the one at the start of the interval on; see stack_walk for `leaf` and `limit`. Where a link
/// or a record is missing, the stack takes over from the root at the time reached.
template <class Leaf, class Counts>
HWY_INLINE bool link_walk(const Tree& tree, const Links& links, LinkStart& start, Interval at, const WalkRay& ray,
                          const float& limit, Leaf&& leaf, Counts& counts) {
  std::uint32_t record = start.record;
  if (record != 0 && is_within(links.leaf(record), ray, at.t0)) {
    counts.node();
  } else {
    record = links.record_of(descend(tree, 0, ray, at.t0, counts));
    start.record = record;
  }
  while (record != 0) {
    // Leave through the plane with the earliest time.
    const LinkedLeaf& here = links.leaf(record);
    std::uint32_t face = face_of(0, ray.far_low[0] == 0);
    float exit = plane_time(ray, here.faces[face], 0);
    for (std::uint32_t axis = 1; axis < 3; ++axis) {
      const std::uint32_t other = face_of(axis, ray.far_low[axis] == 0);
      const float t = plane_time(ray, here.faces[other], axis);
      face = t < exit ? other : face;
      exit = t < exit ? t : exit;
    }
    counts.leaf();
    if (here.blocks.count != 0 && leaf(here.blocks, at.t0, exit < at.t1 ? exit : at.t1)) return true;
    if (!(exit < at.t1)) return false;
    at.t0 = exit;
    if (at.t0 > limit) return false;
    const Link link = links.follow(here, face);
    if (link.is_leaf()) {
      counts.link();
      counts.node();
      record = link.target();
    } else if (link.is_set()) {
      counts.link();
      record = links.record_of(descend(tree, link.target(), ray, at.t0, counts));
    } else {
      break;
    }
  }
  counts.missing_link();
  return stack_walk(tree, 0, at, ray, limit, leaf, counts);
}

/// The walk of the kernels that have Links as their side table.
struct LinkWalk {
  struct State {
    const Links* links;
    LinkStart start;

    explicit State(const SceneView& scene) : links(static_cast<const Links*>(scene.side)) {}
  };
  static constexpr bool kNearFirst = true;

  template <class Leaf, class Counts>
  static HWY_INLINE bool walk(const SceneView& scene, State& state, const WalkRay& ray, const float& limit, Leaf&& leaf,
                              Counts& counts) {
    const Interval at = clip_to_root(ray, *scene.tree);
    if (!(at.t0 <= at.t1)) return false;
    if (HWY_UNLIKELY(!state.links)) return stack_walk(*scene.tree, 0, at, ray, limit, leaf, counts);
    return link_walk(*scene.tree, *state.links, state.start, at, ray, limit, leaf, counts);
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
