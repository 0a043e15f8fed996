// SPDX-License-Identifier: Apache-2.0
// All rays of a call as the light sees them: read into groups, one walk for all groups, packets of rays against what
// their group may meet.

#if defined(UMBRIX_KERNELS_LIGHT_TRACE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_LIGHT_TRACE_INL_H_
#undef UMBRIX_KERNELS_LIGHT_TRACE_INL_H_
#else
#define UMBRIX_KERNELS_LIGHT_TRACE_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "core/float_mode.h"
#include "core/parallel_for.h"
#include "kernels/bvh_kernel-inl.h"
#include "kernels/light_packets-inl.h"
#include "kernels/light_rays-inl.h"
#include "kernels/light_walk-inl.h"
#include "kernels/near_rays.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

/// Of a call; hosts' calls of more are several.
inline constexpr std::size_t kMostViewRays = std::size_t{1} << 20;

/// One call's view.
template <class Counts>
class LightTrace {
 public:
  LightTrace(const SceneView& scene, const LightViewTable& table) : scene_(scene), table_(table) {}

  /// Answers all rays. False, with nothing done, if they are not for it: there are few, or not very many and those far
  /// apart, they do not end at one light, the light sees each among very many triangles, or there is no memory.
  bool trace(const GroupRays& rays) {
    if (rays.rays.count < kFewestRays || rays.rays.count > kMostViewRays) return false;
    if (std::abs(scene_.tree->scale_exponent) > kMostScale || table_.bvh().empty()) return false;
    const DefaultFloatMode mode;
    const std::size_t many = std::max(kManyRays, scene_.kept_count / kTrianglesOfRay);
    if (rays.rays.count < many && !start_densely(rays.rays, *scene_.tree)) return false;
    try {
      if (!kCounts && rays.executor && rays.rays.count >= 2 * kFewestSharedRays) return trace_shared(rays);
      const BorrowedScratch scratch(table_);
      return trace(rays, *scratch);
    } catch (...) {  // no memory, no threads, or a host's that fail
      return false;
    }
  }

 private:
  static constexpr bool kCounts = !std::is_same_v<Counts, NoCounts>;
  /// Fewer rays cost less otherwise.
  static constexpr std::size_t kFewestRays = 128;
  /// So many, and at least one for so many triangles, are near each other wherever they start; fewer that start far
  /// apart had better walk alone.
  static constexpr std::size_t kManyRays = 1u << 13, kTrianglesOfRay = 32;
  /// Of many rays so many are answered at a time, so that what is kept of them stays in the caches of a core.
  static constexpr std::size_t kBatchRays = 1u << 17;
  /// Fewer are not worth a batch of their own. Threads take several, as some cost more.
  static constexpr std::size_t kFewestSharedRays = 1u << 14, kBatchesOfThread = 4;
  /// Sorting pays where many rays come to each direction.
  static constexpr std::size_t kSortedRays = 1u << 14;
  /// So far the scene's scale is from 1 that a denormal of the host could matter.
  static constexpr int kMostScale = 60;

  /// What its batches share.
  struct Call {
    const GroupRays& rays;
    LightViewScratch& scratch;
    float scale;
    LightPoint light;
    std::vector<Counts>& each;  ///< work of each ray, if it is counted
  };

  bool trace(const GroupRays& rays, LightViewScratch& scratch) const {
    const std::size_t all = rays.rays.count;
    const float scale = power_of_two(scene_.tree->scale_exponent);
    std::vector<Counts> each(kCounts ? all : 0);
    const Call call{rays, scratch, scale, find_light(rays.rays, scale), each};
    std::size_t begin = 0;
    bool is_ordered = true;
    while (is_ordered && all - begin >= 2 * kBatchRays) {
      is_ordered = trace_batch(call, begin, begin + kBatchRays, true);
      if (is_ordered) begin += kBatchRays;
    }
    if (!trace_batch(call, begin, all, is_ordered)) return false;
    deliver(rays, each);
    return true;
  }

  /// The same by an executor's threads. They take the next rays as they are ready, since some cost more than others;
  /// rays in no order cost alike, and share more the more they are.
  bool trace_shared(const GroupRays& rays) const {
    const std::size_t all = rays.rays.count, threads = thread_count(rays.executor);
    const bool are_dense = start_densely(rays.rays, *scene_.tree);
    const std::size_t share = (all + threads - 1) / threads;
    const std::size_t size =
        are_dense ? std::clamp(share / kBatchesOfThread, kFewestSharedRays, kBatchRays) : std::max(share, kBatchRays);
    const float scale = power_of_two(scene_.tree->scale_exponent);
    const LightPoint light = find_light(rays.rays, scale);
    std::vector<Counts> none;
    std::atomic<std::size_t> next{0};
    std::atomic<bool> are_for_it{true};
    std::atomic<bool> are_ordered{are_dense};  // once some are not, those that come later are not tried
    parallel_for(rays.executor, threads, [&](std::size_t) {
      const DefaultFloatMode mode;
      const BorrowedScratch scratch(table_);
      const Call call{rays, *scratch, scale, light, none};
      while (are_for_it) {
        const std::size_t count = are_dense && !are_ordered ? 2 * size : size, begin = next.fetch_add(count);
        if (begin >= all) break;
        const std::size_t end = std::min(begin + count, all);
        if (are_ordered && trace_batch(call, begin, end, true)) continue;
        are_ordered = false;
        if (!trace_batch(call, begin, end, false)) are_for_it = false;
      }
    });
    if (are_for_it) deliver(rays, none);
    return are_for_it;
  }

  /// Answers the rays from `begin` to `end`. False if they had better be answered otherwise: with all after them,
  /// sorted, or if they are the last, not here.
  bool trace_batch(const Call& call, std::size_t begin, std::size_t end, bool is_ordered) const {
    const GroupRays& rays = call.rays;
    LightRays light_rays(rays.rays, begin, end, call.scale, call.light, call.scratch);
    if (!light_rays.read(is_ordered)) return false;
    const ViewErrors errors = light_rays.errors();
    const auto walk = [&] {
      if constexpr (kCounts) std::fill(call.each.data() + begin, call.each.data() + end, Counts());
      LightPackets<Counts> packets(scene_, rays, errors, call.scratch, call.each);
      if (!LightWalk(table_.bvh(), call.light, errors, packets, call.scratch).walk()) return false;
      std::memset(rays.out + begin, 0, end - begin);
      packets.finish();
      return true;
    };
    if (!walk() && !(end == rays.rays.count && end - begin >= kSortedRays && light_rays.sort() && walk())) return false;
    trace_odd(rays, call.scratch, call.each);
    return true;
  }

  void trace_odd(const GroupRays& rays, const LightViewScratch& scratch, std::vector<Counts>& each) const {
    using Single = BvhKernel;
    Filter filter(scene_, rays.mask);
    typename Single::State state(scene_);
    NoCounts none;
    for (const std::uint32_t i : scratch.odd) {
      if (rays.skip) filter.set_skip(rays.skip[i]);
      if constexpr (kCounts)
        rays.out[i] = Single::occluded(scene_, filter, rays.rays[i], state, each[i]);
      else
        rays.out[i] = Single::occluded(scene_, filter, rays.rays[i], state, none);
    }
  }

  static void deliver(const GroupRays& rays, const std::vector<Counts>& each) {
    const std::size_t count = rays.rays.count;
    if (rays.routes) std::fill(rays.routes, rays.routes + count, RayRoute::beam);
    if (rays.route_rays) rays.route_rays[static_cast<std::size_t>(RayRoute::beam)] += count;
    if constexpr (kCounts) {
      for (std::size_t i = 0; i < count; ++i) {
        const RayCounts& work = each[i].counts;
        const bool occluded = rays.out[i] != 0;
        if (rays.each) rays.each[i] = work;
        if (!rays.sums) continue;
        (occluded ? rays.sums->counts.occluded : rays.sums->counts.unoccluded) += work;
        rays.sums->by_route[static_cast<std::size_t>(RayRoute::beam)][occluded ? 1 : 0] += work;
      }
    }
  }

  const SceneView& scene_;
  const LightViewTable& table_;
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
