// SPDX-License-Identifier: Apache-2.0
// A kernel made from a walk over the tree: leaves are tested in blocks, whatever order they are visited in. A walk
// class has
//   struct State;                        what lasts from ray to ray of one call; made from a SceneView
//   static constexpr bool kNearFirst;    leaves come in the order of t; if they do not, closest-hit queries take the
//                                        plain stack walk, since only an order of t lets a hit end them
//   template <class Leaf, class Counts> static bool walk(const SceneView&, State&, const WalkRay&, const float& limit,
//                                                        Leaf&& leaf, Counts&);
// and calls leaf(run, t0, t1) for each leaf that holds something, until it returns true.

#if defined(UMBRIX_KERNELS_TREE_KERNEL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_TREE_KERNEL_INL_H_
#undef UMBRIX_KERNELS_TREE_KERNEL_INL_H_
#else
#define UMBRIX_KERNELS_TREE_KERNEL_INL_H_
#endif

#include <hwy/highway.h>

#include <cmath>
#include <limits>

#include "kernels/far_ray.h"
#include "kernels/leaf_test-inl.h"
#include "kernels/queries-inl.h"
#include "kernels/walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

/// The lane of the lowest bit.
HWY_INLINE std::uint32_t lane_of(std::uint32_t bits) {
  return static_cast<std::uint32_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(bits));
}

/// Tells the observer what ended the ray, if it is where the next ray can meet it first. True.
template <class Counts>
HWY_INLINE bool note_blocker(Counts& counts, const Block& block, std::uint32_t lane) {
  return counts.blocked_by(block, lane);
}
template <class Counts>
HWY_INLINE bool note_blocker(Counts&, const TriangleRows&, std::uint32_t) {
  return true;
}

/// Does the block hold a triangle that blocks the ray? No first vertex in it is farther than `reach` from the origin.
template <class Test, class Triangles, class Counts>
HWY_INLINE bool block_blocks(const SceneView& scene, const Filter& filter, const Ray& ray, const Test& test,
                             const WalkRay& walk_ray, const Triangles& block, float reach, Counts& counts) {
  counts.primitives(block.count);
  LaneBits lanes = test(block, reach, walk_ray.tmax);
  if (HWY_LIKELY((lanes.hit | lanes.undecided) == 0)) return false;
  if (filter.passes_all()) {
    if (lanes.hit) return note_blocker(counts, block, lane_of(lanes.hit));
  } else {
    for (std::uint32_t rest = lanes.hit; rest != 0; rest &= rest - 1) {
      const std::uint32_t id = block.id[lane_of(rest)];
      if (filter.admits(id) && filter.is_opaque(ray, id)) return note_blocker(counts, block, lane_of(rest));
    }
  }
  // The triangle that the ray starts on is the one most often undecided: leave it out before the sharper tests.
  std::uint32_t open = 0;
  for (std::uint32_t rest = lanes.undecided; rest != 0; rest &= rest - 1)
    if (filter.admits(block.id[lane_of(rest)])) open |= rest & (0u - rest);
  if (open == 0) return false;
  lanes = test.with_permanents(block, open);
  for (std::uint32_t rest = lanes.hit; rest != 0; rest &= rest - 1) {
    const std::uint32_t lane = lane_of(rest);
    if (filter.is_opaque(ray, block.id[lane])) return note_blocker(counts, block, lane);
  }
  for (std::uint32_t rest = lanes.undecided; rest != 0; rest &= rest - 1) {
    const std::uint32_t lane = lane_of(rest);
    if (blocks(scene, filter, ray, block.id[lane], counts)) return note_blocker(counts, block, lane);
  }
  return false;
}

/// The same for a leaf's run of blocks, which the ray leaves at `t1`.
template <class Counts>
HWY_INLINE bool leaf_blocks(const SceneView& scene, const Filter& filter, const Ray& ray, const LeafTest& test,
                            const WalkRay& walk_ray, BlockRun run, float t1, Counts& counts) {
  const Block* block = scene.tree->blocks.data() + run.first;
  for (const Block* const end = block + run.count; block != end; ++block)
    if (block_blocks(scene, filter, ray, test, walk_ray, *block, test.reach(*block, t1), counts)) return true;
  return false;
}

/// A float time in the tree's units that is not before the hit.
inline float time_after(const OrderedHit& hit, double time_scale) {
  const double t = std::clamp(hit.t_high * time_scale, -kTimeLimit, kTimeLimit);
  return std::nextafter(static_cast<float>(t), std::numeric_limits<float>::infinity());
}

/// Offers the block's possible hits; `limit` is the time beyond which nothing can come first any more.
template <class Test, class Triangles, class Counts>
HWY_INLINE void block_closest(const SceneView& scene, const Filter& filter, const Ray& ray, const Test& test,
                              const WalkRay& walk_ray, const Triangles& block, float reach, Nearest& nearest,
                              float& limit, Counts& counts) {
  counts.primitives(block.count);
  const LaneBits lanes = test(block, reach, limit);
  for (std::uint32_t rest = lanes.hit | lanes.undecided; rest != 0; rest &= rest - 1) {
    const std::uint32_t id = block.id[lane_of(rest)];
    if (nearest.offer(scene, filter, ray, id, counts))
      limit = std::min(walk_ray.tmax, time_after(nearest.hit, walk_ray.time_scale));
  }
}

/// The same for a leaf's run of blocks, which the ray leaves at `t1`.
template <class Counts>
HWY_INLINE void leaf_closest(const SceneView& scene, const Filter& filter, const Ray& ray, const LeafTest& test,
                             const WalkRay& walk_ray, BlockRun run, float t1, Nearest& nearest, float& limit,
                             Counts& counts) {
  const Block* block = scene.tree->blocks.data() + run.first;
  for (const Block* const end = block + run.count; block != end; ++block)
    block_closest(scene, filter, ray, test, walk_ray, *block, test.reach(*block, t1), nearest, limit, counts);
}

/// What all kernels do with a ray first: an invalid one hits nothing, and a far one goes by far_ray.h, with `boxes` or
/// without. Of others answer(walk_ray) tells.
template <class Counts, class Answer>
HWY_INLINE bool occluded_by(const SceneView& scene, const Filter& filter, const Ray& ray, Counts& counts,
                            const TriangleBvh* boxes, Answer&& answer) {
  if (HWY_UNLIKELY(!is_valid(ray))) {
    counts.invalid_ray();
    return false;
  }
  WalkRay walk_ray;
  if (HWY_UNLIKELY(prepare(ray, *scene.tree, walk_ray) == Reach::far))
    return far_occluded(scene, filter, ray, counts, boxes);
  return answer(walk_ray);
}

/// The same for the nearest hit: find(walk_ray) fills `nearest`.
template <class Counts, class Find>
HWY_INLINE void closest_by(const SceneView& scene, const Filter& filter, const Ray& ray, Nearest& nearest,
                           Counts& counts, const TriangleBvh* boxes, Find&& find) {
  if (HWY_UNLIKELY(!is_valid(ray))) {
    counts.invalid_ray();
    return;
  }
  WalkRay walk_ray;
  if (HWY_UNLIKELY(prepare(ray, *scene.tree, walk_ray) == Reach::far))
    far_closest(scene, filter, ray, nearest, counts, boxes);
  else
    find(walk_ray);
}

template <class Walk>
struct TreeKernel {
  using State = typename Walk::State;

  template <class Counts>
  static HWY_INLINE bool occluded(const SceneView& scene, const Filter& filter, const Ray& ray, State& state,
                                  Counts& counts) {
    return occluded_by(scene, filter, ray, counts, nullptr, [&](const WalkRay& walk_ray) {
      const LeafTest test(walk_ray);
      const auto leaf = [&](BlockRun run, float, float t1) {
        return leaf_blocks(scene, filter, ray, test, walk_ray, run, t1, counts);
      };
      return Walk::walk(scene, state, walk_ray, walk_ray.tmax, leaf, counts);
    });
  }

  template <class Counts>
  static HWY_INLINE void closest(const SceneView& scene, const Filter& filter, const Ray& ray,
                                 [[maybe_unused]] State& state, Nearest& nearest, Counts& counts) {
    closest_by(scene, filter, ray, nearest, counts, nullptr, [&](const WalkRay& walk_ray) {
      if constexpr (Walk::kNearFirst) {
        closest_in<Walk>(scene, filter, ray, walk_ray, state, nearest, counts);
      } else {
        StackWalk::State none(scene);
        closest_in<StackWalk>(scene, filter, ray, walk_ray, none, nearest, counts);
      }
    });
  }

 private:
  template <class NearFirstWalk, class Counts>
  static HWY_INLINE void closest_in(const SceneView& scene, const Filter& filter, const Ray& ray,
                                    const WalkRay& walk_ray, typename NearFirstWalk::State& state, Nearest& nearest,
                                    Counts& counts) {
    const LeafTest test(walk_ray);
    float limit = walk_ray.tmax;
    NearFirstWalk::walk(
        scene, state, walk_ray, limit,
        [&](BlockRun run, float, float t1) {
          leaf_closest(scene, filter, ray, test, walk_ray, run, t1, nearest, limit, counts);
          return false;
        },
        counts);
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
