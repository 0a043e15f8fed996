// SPDX-License-Identifier: Apache-2.0
// The textbook walk: from the root, near child first, far children on a stack (Havran 2000, "Heuristic ray shooting
// algorithms", appendix C), with leaves tested in blocks.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/standard.cpp"

#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
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
namespace {

/// Does a block of the leaf hold a triangle that blocks the ray?
template <class Counts>
HWY_INLINE bool leaf_blocks(const SceneView& scene, const Filter& filter, const Ray& ray, const LeafTest& test,
                            const WalkRay& walk_ray, const Node& leaf, float t1, Counts& counts) {
  const Block* block = scene.tree->blocks.data() + leaf.first_block();
  for (const Block* const end = block + leaf.block_count(); block != end; ++block) {
    counts.primitives(block->count);
    LaneBits lanes = test(*block, t1, walk_ray.tmax);
    if (HWY_LIKELY((lanes.hit | lanes.undecided) == 0)) continue;
    if (filter.passes_all()) {
      if (lanes.hit) return true;
    } else {
      for (std::uint32_t rest = lanes.hit; rest != 0; rest &= rest - 1) {
        const std::uint32_t id = block->id[hwy::Num0BitsBelowLS1Bit_Nonzero32(rest)];
        if (filter.admits(id) && filter.is_opaque(ray, id)) return true;
      }
    }
    // The triangle that the ray starts on is the one most often undecided: leave it out before the sharper tests.
    std::uint32_t open = 0;
    for (std::uint32_t rest = lanes.undecided; rest != 0; rest &= rest - 1)
      if (filter.admits(block->id[hwy::Num0BitsBelowLS1Bit_Nonzero32(rest)])) open |= rest & (0u - rest);
    if (open == 0) continue;
    lanes = test.with_permanents(*block, open);
    for (std::uint32_t rest = lanes.hit; rest != 0; rest &= rest - 1)
      if (filter.is_opaque(ray, block->id[hwy::Num0BitsBelowLS1Bit_Nonzero32(rest)])) return true;
    for (std::uint32_t rest = lanes.undecided; rest != 0; rest &= rest - 1)
      if (blocks(scene, filter, ray, block->id[hwy::Num0BitsBelowLS1Bit_Nonzero32(rest)], counts)) return true;
  }
  return false;
}

/// Offers the leaf's possible hits; `limit` is the time beyond which nothing can come first any more.
template <class Counts>
HWY_INLINE void leaf_closest(const SceneView& scene, const Filter& filter, const Ray& ray, const LeafTest& test,
                             const WalkRay& walk_ray, const Node& leaf, float t1, Nearest& nearest, float& limit,
                             Counts& counts) {
  const Block* block = scene.tree->blocks.data() + leaf.first_block();
  for (const Block* const end = block + leaf.block_count(); block != end; ++block) {
    counts.primitives(block->count);
    const LaneBits lanes = test(*block, t1, limit);
    for (std::uint32_t rest = lanes.hit | lanes.undecided; rest != 0; rest &= rest - 1) {
      const std::uint32_t id = block->id[hwy::Num0BitsBelowLS1Bit_Nonzero32(rest)];
      if (!nearest.offer(scene, filter, ray, id, counts)) continue;
      const double t = std::clamp(nearest.hit.t_high * walk_ray.time_scale, -kTimeLimit, kTimeLimit);
      limit = std::min(walk_ray.tmax, std::nextafter(static_cast<float>(t), std::numeric_limits<float>::infinity()));
    }
  }
}

struct Standard {
  template <class Counts>
  static HWY_INLINE bool occluded(const SceneView& scene, const Filter& filter, const Ray& ray, Counts& counts) {
    if (HWY_UNLIKELY(!is_valid(ray))) {
      counts.invalid_ray();
      return false;
    }
    WalkRay walk_ray;
    if (HWY_UNLIKELY(prepare(ray, *scene.tree, walk_ray) == Reach::far))
      return far_occluded(scene, filter, ray, counts);
    const LeafTest test(walk_ray);
    return walk(
        *scene.tree, walk_ray, walk_ray.tmax,
        [&](const Node& leaf, float, float t1) {
          return leaf_blocks(scene, filter, ray, test, walk_ray, leaf, t1, counts);
        },
        counts);
  }

  template <class Counts>
  static HWY_INLINE void closest(const SceneView& scene, const Filter& filter, const Ray& ray, Nearest& nearest,
                                 Counts& counts) {
    if (HWY_UNLIKELY(!is_valid(ray))) {
      counts.invalid_ray();
      return;
    }
    WalkRay walk_ray;
    if (HWY_UNLIKELY(prepare(ray, *scene.tree, walk_ray) == Reach::far)) {
      far_closest(scene, filter, ray, nearest, counts);
      return;
    }
    const LeafTest test(walk_ray);
    float limit = walk_ray.tmax;
    walk(
        *scene.tree, walk_ray, limit,
        [&](const Node& leaf, float, float t1) {
          leaf_closest(scene, filter, ray, test, walk_ray, leaf, t1, nearest, limit, counts);
          return false;
        },
        counts);
  }
};

const EntryPoints& standard_entry_points() { return entry_points<Standard>(); }

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace umbrix::detail {
namespace {

HWY_EXPORT(standard_entry_points);

}  // namespace

extern const Kernel kStandardKernel = {
    {"standard", "stack walk from the root, near child first; the default for single rays"},
    []() -> const EntryPoints& { return HWY_DYNAMIC_DISPATCH(standard_entry_points)(); }};

}  // namespace umbrix::detail
#endif
