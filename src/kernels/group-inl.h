// SPDX-License-Identifier: Apache-2.0
// Rays that start near each other, answered together. A ray that is guessed to be occluded first meets what blocked the
// rays before it, or what a memory names. The others share one walk (beam-inl.h): a beam that is much thinner in two
// halves is cut before it, one whose list is long after it, and then each half picks its leaves from the list of the
// whole.
//
// A memory says what is known of a ray from before this call. It has
//   void place(rays, begin, order, count);      finds where the rays belong that `order` names, from `begin` on
//   Guess guess(i);  std::uint32_t blocker(i);  what is known there
//   std::uint32_t sure_blocker(i);              the same, if all rays there were blocked
//   bool is_by_ray();                           is it of each ray, or of the rays around as well?
//   void note_blocker(i, blocker);              as the answers come
//   void learn(out, order, count);              when all have come

#if defined(UMBRIX_KERNELS_GROUP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_GROUP_INL_H_
#undef UMBRIX_KERNELS_GROUP_INL_H_
#else
#define UMBRIX_KERNELS_GROUP_INL_H_
#endif

#include <hwy/highway.h>

#include <limits>

#include "kernels/beam-inl.h"
#include "kernels/candidates-inl.h"
#include "kernels/group_rays.h"
#include "kernels/tree_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

template <class Memory, class Counts>
class Group {
 public:
  Group(const SceneView& scene, const WideTree& tree, const GroupRays& rays, Memory& memory, bool try_candidates)
      : scene_(scene),
        tree_(tree),
        rays_(rays),
        memory_(memory),
        filter_(scene, rays.mask),
        recent_(scene),
        try_candidates_(try_candidates) {}

  /// Answers all rays.
  void trace() {
    for (begin_ = 0; begin_ < rays_.rays.count; begin_ += kMostRays) {
      const auto count = static_cast<std::uint32_t>(std::min<std::size_t>(kMostRays, rays_.rays.count - begin_));
      prepare_all(count);
      const std::uint32_t placed = active_;
      std::uint16_t in_order[kMostRays];
      std::copy(order_, order_ + placed, in_order);
      memory_.place(rays_, begin_, in_order, placed);
      if (try_candidates_) try_remembered();
      if (active_ > 0) share_walk(0, active_);
      memory_.learn(rays_.out, in_order, placed);
      work_.deliver(rays_, begin_, count);
    }
  }

  const CandidateTries& tries() const { return tries_; }

 private:
  /// Longer lists cost more than cutting the group.
  static constexpr std::uint32_t kMostLeaves = 256;
  /// Smaller groups gain less from sharing than they lose.
  static constexpr std::uint32_t kFewRays = 16, kFewestRays = 4;
  /// A list as short as this is not cut any more.
  static constexpr std::uint32_t kFewLeaves = 8;
  /// Two halves that together are smaller than this much of the whole are better apart.
  static constexpr float kThinner = 0.75f;
  /// How the largest beam changes after one whose list was too long, and after one that was not.
  static constexpr float kShrink = 0.4f, kGrow = 1.1f;

  /// Sets up all rays, and answers those that need no walk or cannot share one.
  void prepare_all(std::uint32_t count) {
    active_ = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      const Ray& ray = rays_.rays[begin_ + i];
      rays_.out[begin_ + i] = 0;
      work_.set_route(i, RayRoute::other);
      if (HWY_UNLIKELY(!is_valid(ray))) {
        work_.of(i).invalid_ray();
        continue;
      }
      Segment& segment = segments_[i];
      if (HWY_UNLIKELY(prepare(ray, *scene_.tree, segment.ray) == Reach::far)) {
        choose_skip(i);
        rays_.out[begin_ + i] = far_occluded(scene_, filter_, ray, work_.of(i));
        continue;
      }
      segment.within = clip_to_root(segment.ray, *scene_.tree);
      if (!(segment.within.t0 <= segment.within.t1)) continue;
      segment.find_ends();
      order_[active_++] = static_cast<std::uint16_t>(i);
    }
  }

  /// Rays that are surely occluded, if what was remembered holds, meet what blocked there before; those that it does
  /// not block stay for the walk.
  void try_remembered() {
    std::uint32_t left = 0;
    for (std::uint32_t k = 0; k < active_;) {
      const std::uint32_t blocker = memory_.sure_blocker(order_[k]);
      if (blocker == Primitive::kNone || !candidates_pay()) {
        order_[left++] = order_[k++];
        continue;
      }
      // The rays of one place follow each other.
      std::uint16_t rays[RayLanes::kMost];
      std::uint32_t count = 0;
      while (k < active_ && count < RayLanes::kMost && memory_.sure_blocker(order_[k]) == blocker)
        rays[count++] = order_[k++];
      recent_.add(blocker);
      gather_lanes(rays, count);
      for (std::uint32_t open = meet_candidates(rays, all_of(count)); open != 0; open &= open - 1)
        order_[left++] = rays[lane_of(open)];
    }
    active_ = left;
  }

  void share_walk(std::uint32_t first, std::uint32_t count) {
    const Beam beam(segments_, order_ + first, count, *scene_.tree);
    if (count <= kFewestRays) {
      for (std::uint32_t k = first; k < first + count; ++k) walk_alone(order_[k]);
      return;
    }
    if (beam.size() > size_limit_ || is_better_apart(beam, first, count)) {
      share_halves(beam, first, count);
      return;
    }
    LeafSpan leaves;
    Counts shared;
    const bool complete = beam.gather(tree_, list_, leaves, kMostLeaves, shared);
    work_.share(shared, order_ + first, count);
    if (complete) {
      size_limit_ *= kGrow;
      pick_leaves(beam, leaves, first, count);
    } else {
      // What is near is alike: spare the beams to come the same.
      size_limit_ = kShrink * beam.size();
      share_halves(beam, first, count);
    }
  }

  void share_halves(const Beam& beam, std::uint32_t first, std::uint32_t count) {
    const std::uint32_t cut = cut_at(beam, first, count);
    share_walk(first, cut);
    share_walk(first + cut, count - cut);
  }

  bool is_better_apart(const Beam& beam, std::uint32_t first, std::uint32_t count) {
    if (count < 2 * kFewRays) return false;
    const std::uint32_t cut = cut_at(beam, first, count);
    const Beam low(segments_, order_ + first, cut, *scene_.tree);
    const Beam high(segments_, order_ + first + cut, count - cut, *scene_.tree);
    return low.size() + high.size() < kThinner * beam.size();
  }

  void pick_leaves(const Beam& beam, LeafSpan leaves, std::uint32_t first, std::uint32_t count) {
    const bool no_room = leaves.end() + leaves.count + kBlockLanes > LeafList::kRoom;
    if (leaves.count <= kFewLeaves || count <= kFewRays || no_room) {
      walk_list(first, count, leaves);
      return;
    }
    const std::uint32_t cut = cut_at(beam, first, count);
    for (const bool high : {false, true}) {
      const std::uint32_t from = high ? first + cut : first, size = high ? count - cut : cut;
      const Beam half(segments_, order_ + from, size, *scene_.tree);
      Counts shared;
      const LeafSpan picked = half.pick(list_, leaves, shared);
      work_.share(shared, order_ + from, size);
      pick_leaves(half, picked, from, size);
    }
  }

  /// Orders the rays so that those on the low side of the middle of the starts' longest extent come first, and returns
  /// how many that are; a half if they are all on one side.
  std::uint32_t cut_at(const Beam& beam, std::uint32_t first, std::uint32_t count) {
    const Vec3 e = beam.starts().extent();
    const int axis = e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
    const float middle = 0.5f * (beam.starts().lower[axis] + beam.starts().upper[axis]);
    std::uint16_t high[kMostRays];
    std::uint32_t lows = 0, highs = 0;
    for (std::uint32_t k = first; k < first + count; ++k) {
      const std::uint16_t i = order_[k];
      if (segments_[i].start[axis] < middle)
        order_[first + lows++] = i;
      else
        high[highs++] = i;
    }
    std::copy(high, high + highs, order_ + first + lows);
    return lows == 0 || highs == 0 ? count / 2 : lows;
  }

  void walk_alone(std::uint16_t i) {
    walk(i, [&](const Segment& segment, auto&& leaf, auto& counts) {
      return wide_walk(tree_, segment.within, segment.ray, leaf, counts);
    });
  }

  /// Answers rays with a common list. What blocks one of them is tried on the others at once.
  void walk_list(std::uint32_t first, std::uint32_t count, LeafSpan leaves) {
    const auto walk_one = [&](std::uint16_t i) {
      return walk(i, [&](const Segment& segment, auto&& leaf, auto& counts) {
        return visit_crossed(list_, leaves, segment, leaf, counts);
      });
    };
    if (!try_candidates_ || !candidates_pay()) {
      for (std::uint32_t k = first; k < first + count; ++k) walk_one(order_[k]);
      return;
    }
    for (std::uint32_t k = first; k < first + count; k += RayLanes::kMost) {
      const std::uint16_t* const rays = order_ + k;
      const std::uint32_t size = std::min(RayLanes::kMost, first + count - k);
      std::uint32_t open = all_of(size);
      bool gathered = false;
      if (memory_.is_by_ray()) {
        gather_lanes(rays, size);
        for (; open != 0; open &= open - 1) {
          const std::uint32_t bit = open & (0u - open);
          const std::uint16_t i = rays[lane_of(bit)];
          const bool is_guessed = memory_.guess(i) == Guess::occluded;
          if (expects_occlusion(i) && (is_guessed ? meet_candidates(rays, bit) : meet_newest(rays, bit)) == 0) continue;
          walk_one(i);
        }
        continue;
      }
      if (!recent_.empty() && expects_occlusion(rays[0])) {
        gather_lanes(rays, size);
        gathered = true;
        open = meet_candidates(rays, open);
      }
      while (open != 0) {
        const std::uint16_t i = rays[lane_of(open)];
        open &= open - 1;
        if (!walk_one(i) || open == 0) continue;
        if (!gathered) gather_lanes(rays, size);
        gathered = true;
        open = meet_newest(rays, open);
      }
    }
  }

  /// Answers a ray by a walk.
  template <class Walk>
  HWY_INLINE bool walk(std::uint16_t i, Walk&& the_walk) {
    choose_skip(i);
    const Ray& ray = rays_.rays[begin_ + i];
    const Segment& segment = segments_[i];
    Noticed<Counts> counts;
    const auto leaf = [&](BlockRun run, float, float t1) {
      const LeafTest test(segment.ray);  // many rays come to no leaf
      return leaf_blocks(scene_, filter_, ray, test, segment.ray, run, t1, counts);
    };
    const bool occluded = the_walk(segment, leaf, counts);
    work_.add(i, counts);
    if (occluded && try_candidates_ && counts.block) recent_.add(*counts.block, counts.lane);
    finish(i, occluded, RayRoute::beam, counts.blocker());
    return occluded;
  }

  static std::uint32_t all_of(std::uint32_t count) { return (1u << count) - 1; }

  void gather_lanes(const std::uint16_t* rays, std::uint32_t count) {
    for (std::uint32_t lane = 0; lane < count; ++lane) lanes_.set(lane, segments_[rays[lane]].ray);
  }

  /// Tries all candidates on the rays named by the bits of `open`; returns those that are not surely blocked.
  std::uint32_t meet_candidates(const std::uint16_t* rays, std::uint32_t open) {
    count_tries(open);
    for (std::uint32_t lane = 0; lane < recent_.block().count && open != 0; ++lane) open = meet(rays, open, lane);
    return open;
  }
  std::uint32_t meet_newest(const std::uint16_t* rays, std::uint32_t open) {
    count_tries(open);
    return meet(rays, open, recent_.newest());
  }

  std::uint32_t meet(const std::uint16_t* rays, std::uint32_t open, std::uint32_t candidate) {
    const std::uint32_t id = recent_.block().id[candidate];
    for (std::uint32_t rest = open; rest != 0; rest &= rest - 1) {
      Counts& counts = work_.of(rays[lane_of(rest)]);
      counts.primitives(1);
      counts.indexed(1);
    }
    for (std::uint32_t rest = lanes_.surely_hit(recent_.block(), candidate, open); rest != 0; rest &= rest - 1) {
      const std::uint16_t i = rays[lane_of(rest)];
      choose_skip(i);
      if (!filter_.admits(id) || !filter_.is_opaque(rays_.rays[begin_ + i], id)) continue;
      open &= ~(rest & (0u - rest));
      ++tries_.blocked;
      finish(i, true, RayRoute::cached, id);
    }
    return open;
  }

  void count_tries(std::uint32_t open) { tries_.tried += hwy::PopCount(open); }

  void finish(std::uint16_t i, bool occluded, RayRoute route, std::uint32_t blocker) {
    rays_.out[begin_ + i] = occluded ? 1 : 0;
    work_.set_route(i, route);
    if (occluded) memory_.note_blocker(i, blocker);
    last_occluded_ = occluded;
  }

  /// What the ray before met says most, and then what is remembered.
  bool expects_occlusion(std::uint16_t i) {
    if (last_occluded_) return true;
    if (memory_.guess(i) != Guess::occluded) return false;
    if (memory_.blocker(i) != Primitive::kNone) recent_.add(memory_.blocker(i));
    return true;
  }

  /// Among leaves of trees no blocker lasts from ray to ray: after a few tries in vain there are no more.
  bool candidates_pay() const { return tries_.tried < 32 || 4 * tries_.blocked >= tries_.tried; }

  void choose_skip(std::uint32_t i) {
    if (rays_.skip) filter_.set_skip(rays_.skip[begin_ + i]);
  }

  const SceneView& scene_;
  const WideTree& tree_;
  const GroupRays& rays_;
  Memory& memory_;
  GroupWork<Counts> work_;
  Filter filter_;
  Candidates recent_;
  bool try_candidates_;
  bool last_occluded_ = false;
  float size_limit_ = std::numeric_limits<float>::max();
  CandidateTries tries_;
  std::size_t begin_ = 0;
  std::uint32_t active_ = 0;
  RayLanes lanes_;
  std::uint16_t order_[kMostRays];  ///< the active rays
  Segment segments_[kMostRays];
  LeafList list_;
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
