// SPDX-License-Identifier: Apache-2.0
// A bounding volume hierarchy made for occlusion queries (Feltman, Lee & Fatahalian 2012). Its nodes stand in the order
// of visits, which is the same for every ray, so the walk is a loop without a stack. Closest hits take the KD-tree.
//
// Boxes are grown by the tree's eps, and that is more than what a plane time may be off (walk-inl.h): a hit's time lies
// in the closed interval of every box around its triangle.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/srdh.cpp"

#include "index/srdh.h"

#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

#include "kernels/training.h"
#include "kernels/tree_kernel-inl.h"
#include "tree/scale.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {
namespace {

/// The part of the ray inside a node's box.
HWY_INLINE Interval clip_to_node(const WalkRay& ray, const SrdhNode& node) {
  Interval at{ray.tmin - 0x1p-100f, ray.tmax + 0x1p-100f};
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    const bool down = ray.far_low[axis] != 0;
    at.t0 = std::max(at.t0, plane_time(ray, node.faces[face_of(axis, down)], axis));
    at.t1 = std::min(at.t1, plane_time(ray, node.faces[face_of(axis, !down)], axis));
  }
  return at;
}

struct SrdhKernel {
  struct State {
    const Srdh* srdh;
    NoState standard;

    explicit State(const SceneView& scene) : srdh(static_cast<const Srdh*>(scene.side)), standard(scene) {}
  };

  template <class Counts>
  static HWY_INLINE bool occluded(const SceneView& scene, const Filter& filter, const Ray& ray, State& state,
                                  Counts& counts) {
    if (HWY_UNLIKELY(!state.srdh)) return TreeKernel<StackWalk>::occluded(scene, filter, ray, state.standard, counts);
    if (HWY_UNLIKELY(!is_valid(ray))) {
      counts.invalid_ray();
      return false;
    }
    WalkRay walk_ray;
    if (HWY_UNLIKELY(prepare(ray, *scene.tree, walk_ray) == Reach::far))
      return far_occluded(scene, filter, ray, counts);
    const LeafTest test(walk_ray);
    const SrdhNode* node = state.srdh->nodes().data();
    const SrdhNode* const end = node + state.srdh->nodes().size();
    while (node != end) {
      counts.node();
      const Interval at = clip_to_node(walk_ray, *node);
      if (!(at.t0 <= at.t1)) {
        node += node->skip;
        continue;
      }
      if (node->is_leaf()) {
        counts.leaf();
        const Block& block = state.srdh->block(*node);
        if (block_blocks(scene, filter, ray, test, walk_ray, block, test.reach(block, at.t1), counts)) return true;
      }
      ++node;
    }
    return false;
  }

  template <class Counts>
  static HWY_INLINE void closest(const SceneView& scene, const Filter& filter, const Ray& ray, State& state,
                                 Nearest& nearest, Counts& counts) {
    TreeKernel<StackWalk>::closest(scene, filter, ray, state.standard, nearest, counts);
  }
};

const EntryPoints& srdh() { return entry_points<SrdhKernel>(); }

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace umbrix::detail {
namespace {

std::unique_ptr<SideTable> make_srdh(const PrepareInput& input) {
  const SceneView& scene = input.scene;
  if (scene.kept_count == 0) return nullptr;
  const DefaultFloatMode mode;
  const std::vector<std::uint32_t> kept(scene.kept, scene.kept + scene.kept_count);
  const std::vector<Triangle> triangles(scene.triangles, scene.triangles + kept.back() + 1);
  return std::make_unique<Srdh>(scaled(triangles, scene.tree->scale_exponent), kept, scene.tree->eps,
                                gather_blockers(input), input.training.executor);
}

}  // namespace
}  // namespace umbrix::detail
UMBRIX_DEFINE_KERNEL(kSrdhKernel, srdh, "srdh", "a hierarchy of its own, built and ordered for the training rays",
                     make_srdh)
#endif
