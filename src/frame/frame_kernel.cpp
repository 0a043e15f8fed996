// SPDX-License-Identifier: Apache-2.0
// A tile's rays by the frame's method: in groups, or each by the walk that its guess asks for.
#include "frame/frame_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "frame/frame_kernel.cpp"

#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

#include "kernels/bvh_kernel-inl.h"
#include "kernels/group-inl.h"
#include "kernels/indexed_walk-inl.h"
#include "kernels/light_trace-inl.h"
#include "kernels/link_walk-inl.h"
#include "kernels/near_rays.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {
namespace {

/// Answers each ray by itself.
template <class Counts>
class EachRay {
 public:
  explicit EachRay(FrameTile& tile)
      : tile_(tile),
        filter_(tile.scene, tile.rays.mask),
        linked_(with_side(tile.tables.links)),
        indexed_(with_side(tile.tables.index)) {}

  void trace() {
    std::uint16_t order[kMostRays];
    for (std::uint16_t i = 0; i < kMostRays; ++i) order[i] = i;
    const std::size_t count = tile_.rays.rays.count;
    for (std::size_t begin = 0; begin < count; begin += kMostRays) {
      const auto size = static_cast<std::uint32_t>(std::min<std::size_t>(kMostRays, count - begin));
      tile_.memory.place(tile_.rays, begin, order, size);
      for (std::uint32_t i = 0; i < size; ++i) answer(begin, i);
      tile_.memory.learn(tile_.rays.out, order, size);
      work_.deliver(tile_.rays, begin, size);
    }
  }

 private:
  SceneView with_side(const SideTable* side) const {
    SceneView view = tile_.scene;
    view.side = side;
    return view;
  }

  void answer(std::size_t begin, std::uint32_t i) {
    const Ray& ray = tile_.rays.rays[begin + i];
    if (tile_.rays.skip) filter_.set_skip(tile_.rays.skip[begin + i]);
    Noticed<Counts> counts;
    const RayRoute route = choose(ray, tile_.memory.guess(i));
    const bool occluded = walk(route, ray, counts);
    work_.add(i, counts);
    tile_.rays.out[begin + i] = occluded ? 1 : 0;
    work_.set_route(i, counts.is_far ? RayRoute::other : route);
    if (occluded) tile_.memory.note_blocker(i, counts.blocker());
  }

  bool walk(RayRoute route, const Ray& ray, Noticed<Counts>& counts) {
    if (route == RayRoute::linked) return TreeKernel<LinkWalk>::occluded(linked_, filter_, ray, link_state_, counts);
    if (route == RayRoute::indexed) {
      IndexedKernel::State state(indexed_);
      return IndexedKernel::occluded(indexed_, filter_, ray, state, counts);
    }
    if (!tile_.tables.view) return TreeKernel<StackWalk>::occluded(tile_.scene, filter_, ray, no_state_, counts);
    return BvhKernel::occluded(tile_.scene, filter_, ray, no_state_, counts);
  }

  RayRoute choose(const Ray& ray, Guess guess) const {
    if (!is_valid(ray)) return RayRoute::other;
    const bool is_paper = tile_.method == FrameMethod::paper;
    if (tile_.method == FrameMethod::indexed || (is_paper && guess == Guess::occluded))
      return IndexedKernel::has_lists(indexed_) ? RayRoute::indexed : RayRoute::other;
    return tile_.method == FrameMethod::linked || is_paper ? RayRoute::linked : RayRoute::other;
  }

  FrameTile& tile_;
  GroupWork<Counts> work_;
  Filter filter_;
  SceneView linked_, indexed_;
  LinkWalk::State link_state_{linked_};
  NoState no_state_{tile_.scene};
};

/// What groups walk. Counted rays build it first, so that counts do not depend on what was asked before.
template <class Counts>
const WideTree* find_wide(const FrameTile& tile) {
  if (!tile.tables.view) return tile.tables.wide;
  if (!go_together(tile.rays.rays, *tile.scene.tree)) return nullptr;
  return !std::is_same_v<Counts, NoCounts> ? tile.tables.view->need_wide()
                                           : tile.tables.view->earn_wide(tile.rays.rays.count);
}

template <class Counts>
void trace_with(FrameTile& tile) {
  if (tile.tables.view && LightTrace<Counts>(tile.scene, *tile.tables.view).trace(tile.rays)) return;
  if (const WideTree* const wide = find_wide<Counts>(tile)) {
    Group<TileMemory, Counts> group(tile.scene, *wide, tile.rays, tile.memory, tile.method != FrameMethod::beam);
    group.trace();
    tile.tries = group.tries();
  } else {
    EachRay<Counts>(tile).trace();
  }
}

void trace(FrameTile& tile) { tile.rays.counts() ? trace_with<CountEach>(tile) : trace_with<NoCounts>(tile); }

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace umbrix::detail {
namespace {

HWY_EXPORT(trace);

}  // namespace

void trace_tile(FrameTile& tile) noexcept { HWY_DYNAMIC_DISPATCH(trace)(tile); }

}  // namespace umbrix::detail
#endif
