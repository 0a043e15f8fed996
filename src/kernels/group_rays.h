// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <type_traits>

#include "kernels/counts.h"
#include "kernels/scene_view.h"
#include "umbrix/frame.h"

namespace umbrix::detail {

/// As many rays are traced together: a tile of 16x16 pixels.
inline constexpr std::uint32_t kMostRays = 256;

/// Work by the true answer, and by how it was found: [0] unoccluded, [1] occluded.
struct WorkSums {
  OcclusionCounts counts;
  RayCounts by_route[kRayRoutes][2];
};

/// Rays to be answered in groups, and where what is found goes.
struct GroupRays {
  RaySpan rays;
  std::uint8_t* out;
  const Primitive* skip = nullptr;  ///< one a ray, or null
  std::uint32_t mask = 0xFFFFFFFFu;
  RayRoute* routes = nullptr;  ///< one a ray, or null
  RayCounts* each = nullptr;   ///< one a ray, or null; of groups that count, like the next
  WorkSums* sums = nullptr;
  std::uint64_t* route_rays = nullptr;  ///< by route, or null
  const Executor* executor = nullptr;   ///< what may share the work; null: the calling thread alone

  bool counts() const noexcept { return each || sums; }
};

/// How many rays met candidates, and how many of them were answered by one.
struct CandidateTries {
  std::uint64_t tried = 0, blocked = 0;
};

/// The work done for up to kMostRays rays and the way each was answered.
template <class Counts>
class GroupWork {
 public:
  Counts& of(std::uint32_t i) noexcept {
    if constexpr (kCounts)
      return each_[i];
    else
      return none_;
  }
  void add(std::uint32_t i, const Counts& work) noexcept {
    if constexpr (kCounts) each_[i].add(work);
  }
  /// Deals out the node tests of a shared walk in equal parts, the first rays taking the rest.
  void share(const Counts& work, const std::uint16_t* order, std::uint32_t count) noexcept {
    if constexpr (kCounts) {
      const std::uint64_t all = work.counts.node_tests;
      for (std::uint32_t k = 0; k < count; ++k)
        each_[order[k]].counts.node_tests += all / count + (k < all % count ? 1 : 0);
    }
  }
  void set_route(std::uint32_t i, RayRoute route) noexcept { routes_[i] = route; }

  /// Hands out what was done for `count` rays from `begin` on, and begins anew.
  void deliver(const GroupRays& rays, std::size_t begin, std::uint32_t count) noexcept {
    if (rays.routes) std::copy(routes_, routes_ + count, rays.routes + begin);
    if (rays.route_rays)
      for (std::size_t route = 0; route < kRayRoutes; ++route)
        rays.route_rays[route] +=
            static_cast<std::uint64_t>(std::count(routes_, routes_ + count, static_cast<RayRoute>(route)));
    if constexpr (kCounts) {
      for (std::uint32_t i = 0; i < count; ++i) {
        const RayCounts& work = each_[i].counts;
        const bool occluded = rays.out[begin + i] != 0;
        if (rays.each) rays.each[begin + i] = work;
        if (rays.sums) {
          (occluded ? rays.sums->counts.occluded : rays.sums->counts.unoccluded) += work;
          rays.sums->by_route[static_cast<std::size_t>(routes_[i])][occluded ? 1 : 0] += work;
        }
        each_[i] = CountEach();
      }
    }
  }

 private:
  static constexpr bool kCounts = !std::is_same_v<Counts, NoCounts>;

  CountEach each_[kCounts ? kMostRays : 1];
  RayRoute routes_[kMostRays];
  NoCounts none_;
};

/// An observer that also notes which triangle blocked the ray, and whether the ray was too far for any walk but one.
template <class Counts>
struct Noticed : Counts {
  const Block* block = nullptr;
  std::uint32_t lane = 0;
  bool is_far = false;

  void far_ray() noexcept {
    is_far = true;
    Counts::far_ray();
  }
  bool blocked_by(const Block& the_block, std::uint32_t the_lane) noexcept {
    block = &the_block;
    lane = the_lane;
    return true;
  }
  std::uint32_t blocker() const noexcept { return block ? block->id[lane] : Primitive::kNone; }
};

/// What is thought of a ray before it is traced.
enum class Guess : std::uint8_t { unknown, unoccluded, occluded };

/// What a group knows of rays from before the call: nothing.
struct NoMemory {
  void place(const GroupRays&, std::size_t, const std::uint16_t*, std::uint32_t) noexcept {}
  Guess guess(std::uint32_t) const noexcept { return Guess::unknown; }
  bool is_by_ray() const noexcept { return false; }
  std::uint32_t sure_blocker(std::uint32_t) const noexcept { return Primitive::kNone; }
  std::uint32_t blocker(std::uint32_t) const noexcept { return Primitive::kNone; }
  void note_blocker(std::uint32_t, std::uint32_t) noexcept {}
  void learn(const std::uint8_t*, const std::uint16_t*, std::uint32_t) noexcept {}
};

}  // namespace umbrix::detail
