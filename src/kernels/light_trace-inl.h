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
#include <deque>
#include <vector>

#include "core/float_mode.h"
#include "core/parallel_for.h"
#include "kernels/bvh_kernel-inl.h"
#include "kernels/light_packets-inl.h"
#include "kernels/light_rays-inl.h"
#include "kernels/light_sort-inl.h"
#include "kernels/light_walk-inl.h"
#include "kernels/near_rays.h"
#include "kernels/ray_blocks.h"

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
    const bool are_dense = start_densely(rays.rays, *scene_.tree);
    if (rays.rays.count < many && !are_dense) return false;
    try {
      Call call(rays, power_of_two(scene_.tree->scale_exponent), table_);
      const std::size_t answered = are_dense ? trace_ordered(call) : 0;
      if (answered < rays.rays.count && !(call.is_for_it && trace_sorted(call, answered))) return false;
      deliver(rays, call.each);
      return true;
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
  /// Sorting pays where many rays come to each direction.
  static constexpr std::size_t kSortedRays = 1u << 14;
  /// So far the scene's scale is from 1 that a denormal of the host could matter.
  static constexpr int kMostScale = 60;

  /// What its batches share.
  struct Call {
    const GroupRays& rays;
    float scale;
    LightPoint light;
    std::vector<Counts> each;               ///< work of each ray, if it is counted
    std::deque<BorrowedScratch> scratches;  ///< one for each thread
    std::atomic<std::size_t> end;           ///< of the rays that are answered in the way that is tried
    std::atomic<bool> is_for_it{true};

    Call(const GroupRays& its, float its_scale, const LightViewTable& table)
        : rays(its),
          scale(its_scale),
          light(find_light(its.rays, its_scale)),
          each(kCounts ? its.rays.count : 0),
          end(its.rays.count) {
      const std::size_t most = kCounts ? 1 : std::max<std::size_t>(1, rays.rays.count / kFewestBatchRays);
      const std::size_t threads = rays.executor ? std::min(most, thread_count(rays.executor)) : 1;
      for (std::size_t i = 0; i < threads; ++i) scratches.emplace_back(table);
    }

    /// Rays from `begin` on are not answered in that way.
    void end_at(std::size_t begin) {
      std::size_t known = end;
      while (begin < known && !end.compare_exchange_weak(known, begin)) {
      }
    }

    /// body(number, scratch) by each thread.
    template <class Body>
    void run(Body&& body) {
      if (scratches.size() == 1) return body(0, *scratches[0]);
      parallel_for(rays.executor, scratches.size(), [&](std::size_t i) {
        const DefaultFloatMode mode;
        body(i, *scratches[i]);
      });
    }
  };

  /// Answers batches of rays as they come, as threads are ready for them, up to the first that had better be sorted.
  /// Returns where that begins.
  std::size_t trace_ordered(Call& call) const {
    const std::size_t all = call.rays.rays.count, threads = call.scratches.size();
    RayBlocks batches(all, threads, kFewestBatchRays, kMostBatchRays);
    call.run([&](std::size_t, LightViewScratch& scratch) {
      for (RayBlocks::Block batch; batches.take(batch) && batch.begin < call.end;)
        if (!trace_batch(call, batch.begin, batch.end, scratch)) call.end_at(batch.begin);
    });
    return call.end;
  }

  bool trace_batch(Call& call, std::size_t begin, std::size_t end, LightViewScratch& scratch) const {
    LightRays light_rays(call.rays.rays, begin, end, call.scale, call.light, scratch);
    if (!light_rays.read()) return false;
    clear_answers(call, begin, end);
    if (walk(call, begin, light_rays.errors(), most_met(end - begin), scratch) == 0) {
      if (call.end > begin && call.rays.rays.count - begin < kSortedRays) call.is_for_it = false;
      return false;
    }
    trace_odd(call, scratch);
    return true;
  }

  /// Answers the rays from `begin` on: threads sort equal slices, and then take pieces of what they sorted together.
  bool trace_sorted(Call& call, std::size_t begin) const {
    const std::size_t all = call.rays.rays.count, threads = call.scratches.size();
    std::vector<ViewErrors> errors(threads);
    std::vector<const LightViewScratch*> slices(threads);
    call.end = all;
    call.run([&](std::size_t i, LightViewScratch& scratch) {
      const std::size_t first = begin + i * (all - begin) / threads, last = begin + (i + 1) * (all - begin) / threads;
      LightSlice slice(call.rays.rays, first, last, call.scale, call.light, scratch);
      if (!slice.sort()) return call.end_at(begin);
      errors[i] = slice.errors();
      slices[i] = &scratch;
      clear_answers(call, first, last);
      trace_odd(call, scratch);
    });
    if (call.end == begin) return false;
    const LightPieces pieces(slices);
    const ViewErrors most = largest(errors);
    std::atomic<std::size_t> next{0}, met{0};
    call.run([&](std::size_t, LightViewScratch& scratch) {
      for (std::size_t i; (i = next.fetch_add(1)) < pieces.count() && call.end == all;) {
        pieces.take(i, scratch);
        // Some pieces meet more triangles than the others: what counts is how many all do.
        const std::size_t room = most_met(all - begin) - std::min(met.load(), most_met(all - begin));
        const std::size_t left = walk(call, begin, most, room, scratch);
        if (left == 0) call.end_at(begin);
        met += room - left;
      }
    });
    return call.end == all;
  }

  /// So often triangles may meet groups of so many rays, or those had better be walked otherwise.
  static std::size_t most_met(std::size_t rays) { return 64 * rays + 4096; }

  static ViewErrors largest(const std::vector<ViewErrors>& all) {
    ViewErrors most;
    for (const ViewErrors& e : all)
      most = {std::max(most.start, e.start), std::max(most.end, e.end), std::max(most.most, e.most)};
    return most;
  }

  static void clear_answers(Call& call, std::size_t begin, std::size_t end) {
    if constexpr (kCounts) std::fill(call.each.data() + begin, call.each.data() + end, Counts());
    std::memset(call.rays.out + begin, 0, end - begin);
  }

  /// Answers the scratch's groups: notes what is blocked, where all are noted not to be. Returns how often triangles
  /// may still meet groups, from so many times; zero, if they may not or it is in vain, and the answers are of no use.
  std::size_t walk(Call& call, std::size_t begin, const ViewErrors& errors, std::size_t room,
                   LightViewScratch& scratch) const {
    LightPackets<Counts> packets(scene_, call.rays, errors, scratch, call.each);
    const GivenUp is_given_up{call.end, begin};
    LightWalk walk(table_.bvh(), call.light, errors, packets, scratch, is_given_up);
    const std::size_t left = walk.walk(room);
    if (left != 0) packets.finish();
    return left;
  }

  void trace_odd(Call& call, const LightViewScratch& scratch) const {
    const GroupRays& rays = call.rays;
    using Single = BvhKernel;
    Filter filter(scene_, rays.mask);
    typename Single::State state(scene_);
    NoCounts none;
    for (const std::uint32_t i : scratch.odd) {
      if (rays.skip) filter.set_skip(rays.skip[i]);
      if constexpr (kCounts)
        rays.out[i] = Single::occluded(scene_, filter, rays.rays[i], state, call.each[i]);
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
