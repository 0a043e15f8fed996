// SPDX-License-Identifier: Apache-2.0
// Which rays of a bundle are blocked, row of triangles by row. What the bounds leave open goes to the exact test.

#if defined(UMBRIX_KERNELS_BUNDLE_ANSWER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_BUNDLE_ANSWER_INL_H_
#undef UMBRIX_KERNELS_BUNDLE_ANSWER_INL_H_
#else
#define UMBRIX_KERNELS_BUNDLE_ANSWER_INL_H_
#endif

#include <hwy/highway.h>

#include "kernels/group_rays.h"
#include "kernels/row_rays-inl.h"
#include "kernels/shaft_packets-inl.h"
#include "kernels/tree_kernel-inl.h"
#include "kernels/walk_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

class BundleAnswer {
 public:
  BundleAnswer(const SceneView& scene, const GroupRays& rays)
      : scene_(scene), rays_(rays), filter_(scene, rays.mask), plain_(!rays.skip && filter_.passes_all()) {}

  void start(const RayBundle& bundle) {
    bundle_ = &bundle;
    blocked_ = ~((1u << bundle.count) - 1) & kAll;
    unsure_count_ = 0;
  }

  /// Lanes that nothing is known to block; those without a ray are blocked.
  std::uint32_t open() const { return ~blocked_ & kAll; }

  /// All rays against the `wanted` triangles of a row, none of them farther than `reach`.
  HWY_INLINE void meet(const BundleView& view, const TriangleRows& rows, std::uint32_t wanted, float reach) {
    const SeenLanes seen = view.look(rows, wanted, reach, seen_);
    if (seen.met == 0) return;
    if (plain_ && (seen.blocks & seen.met) != 0 && !bundle_->has_begin) {
      blocked_ = kAll;
      return;
    }
    for (std::uint32_t rest = seen.met; rest != 0; rest &= rest - 1) {
      const std::uint32_t lane = first_lane(rest);
      const RayHits hits = view.meet(seen_, lane, (seen.edge_on >> lane & 1) != 0);
      if (HWY_LIKELY(plain_)) {
        blocked_ |= hits.hit;
        if (blocked_ == kAll) return;
      } else if ((hits.hit & ~blocked_) != 0) {
        admit(rows.id[lane], hits.hit & ~blocked_);
      }
      if (HWY_UNLIKELY((hits.unsure & ~blocked_) != 0)) note_unsure(rows.id[lane], hits.unsure);
    }
  }

  /// Those of the rays in `lanes` that are open.
  HWY_INLINE void meet_alone(const WalkRays& rays, std::uint32_t lanes, const TriangleRows& rows, float reach) {
    NoCounts none;
    std::uint32_t here = lanes & open();
    if (here == 0) return;
    if (kMeetsTogether && HWY_LIKELY(plain_)) {
      const RayHits hits = RowRays(rays, rows, reach).meet(here);
      blocked_ |= hits.hit;
      here = hits.unsure;
    }
    for (std::uint32_t rest = here; rest != 0; rest &= rest - 1) {
      const std::uint32_t lane = first_lane(rest);
      const std::size_t i = select(lane);
      const WalkRay ray = rays.ray(lane);
      if (block_blocks(scene_, filter_, rays_.rays[i], RowTest(ray), ray, rows, reach, none)) blocked_ |= 1u << lane;
    }
  }

  /// Decides what is unsure, and tells which rays are blocked.
  void finish() {
    for (std::uint32_t i = 0; i < unsure_count_; ++i) decide(unsure_[i].id, unsure_[i].lanes);
    for (std::uint32_t rest = blocked_ & ((1u << bundle_->count) - 1); rest != 0; rest &= rest - 1)
      rays_.out[bundle_->first + first_lane(rest)] = 1;
  }

 private:
  /// The ray of a lane, for which the filter is set.
  std::size_t select(std::uint32_t lane) {
    const std::size_t i = bundle_->first + lane;
    if (rays_.skip) filter_.set_skip(rays_.skip[i]);
    return i;
  }

  /// Other triangles may yet block these rays for certain.
  void note_unsure(std::uint32_t id, std::uint32_t lanes) {
    if (unsure_count_ == kMostUnsure)
      decide(id, lanes);
    else
      unsure_[unsure_count_++] = {id, lanes};
  }

  HWY_NOINLINE void decide(std::uint32_t id, std::uint32_t lanes) {
    NoCounts none;
    for (std::uint32_t rest = lanes & ~blocked_; rest != 0; rest &= rest - 1) {
      const std::size_t i = select(first_lane(rest));
      if (blocks(scene_, filter_, rays_.rays[i], id, none)) blocked_ |= rest & (0u - rest);
    }
  }

  HWY_NOINLINE void admit(std::uint32_t id, std::uint32_t lanes) {
    for (std::uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
      const std::size_t i = select(first_lane(rest));
      if (filter_.admits(id) && filter_.is_opaque(rays_.rays[i], id)) blocked_ |= rest & (0u - rest);
    }
  }

  /// Of rays against a row in pieces, those by themselves can stop after the first.
  static constexpr bool kMeetsTogether = HWY_LANES(float) >= kRowLanes;

  struct Unsure {
    std::uint32_t id, lanes;
  };
  static constexpr std::uint32_t kMostUnsure = 32, kAll = 0xFFFF;

  const SceneView& scene_;
  const GroupRays& rays_;
  Filter filter_;
  bool plain_;
  const RayBundle* bundle_ = nullptr;
  std::uint32_t blocked_ = kAll;
  Unsure unsure_[kMostUnsure];
  std::uint32_t unsure_count_ = 0;
  SeenTriangles seen_;
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
