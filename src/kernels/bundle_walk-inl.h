// SPDX-License-Identifier: Apache-2.0
// A bundle's rays through the folded hierarchy together. Boxes come in one order for all rays, so that each ray meets
// what it would meet alone; but they share the fetching of nodes, and do not wait for themselves (after Tsakok 2009,
// "Faster incoherent rays: multi-BVH ray stream tracing"). Times are parts of the way, as in bundle_hull-inl.h.

#if defined(UMBRIX_KERNELS_BUNDLE_WALK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_BUNDLE_WALK_INL_H_
#undef UMBRIX_KERNELS_BUNDLE_WALK_INL_H_
#else
#define UMBRIX_KERNELS_BUNDLE_WALK_INL_H_
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <optional>
#include <vector>

#include "index/folded_bvh.h"
#include "kernels/bundle_answer-inl.h"
#include "kernels/bundle_hull-inl.h"
#include "kernels/bundle_times-inl.h"
#include "kernels/compress-inl.h"
#include "kernels/walk_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

/// A bundle that walks by itself, step by step.
class BundleWalk {
 public:
  BundleWalk(const SceneView& scene, const GroupRays& rays) : scene_(scene), rays_(rays), answer_(scene, rays) {}

  /// False, with none of its rays marked, if they start far off. The bundle must outlive the steps.
  bool start(const RayBundle& bundle) {
    if (!walk_rays_.prepare(rays_.rays, bundle, *scene_.tree)) return false;
    times_.set(bundle);
    answer_.start(bundle);
    hull_.emplace(bundle);
    view_.emplace(bundle);
    pending_ = leaf_count_ = 0;
    child_ = 0;
    active_ = answer_.open();
    return true;
  }

  /// Meets the leaves that the last step had fetched, and goes through the next node, or through all. False if none is
  /// left: then the rays that are blocked are marked.
  template <bool kAll>
  bool step() {
    const FoldedBvh& bvh = *scene_.folded;
    const BundleHull& hull = *hull_;
    const BundleView& view = *view_;
    std::uint32_t pending = pending_, child = child_, active = active_;
    if constexpr (!kAll) {
      for (std::uint32_t i = 0; i < leaf_count_; ++i)
        meet(view, *leaves_[i].rows, leaves_[i].lanes & answer_.open(), leaves_[i].reach);
      if (leaf_count_ != 0 && !pop(pending, child, active)) return false;
      leaf_count_ = 0;
    }
    do {
      const FoldedNode& node = bvh.node(child);
      Faces faces;
      RaysByBox rays;
      cross(hull, node, active, faces, rays);
      const std::uint32_t leaves = push_inner(node, rays, pending);
      if (pending > 0) prefetch_lines(&bvh.node(children_[pending - 1]), sizeof node);
      for (std::uint32_t rest = leaves; rest != 0; rest &= rest - 1) {
        const std::uint32_t lane = lane_of(rest);
        const TriangleRows& rows = bvh.rows(node.child[lane] & ~BvhNode::kLeaf);
        if constexpr (kAll) {
          meet(view, rows, rays.of[lane] & answer_.open(), faces.reach[lane]);
        } else {
          prefetch_lines(&rows, offsetof(TriangleRows, normal));
          leaves_[leaf_count_++] = {&rows, rays.of[lane], faces.reach[lane]};
        }
      }
      if (!kAll && leaves != 0) break;
      if (!pop(pending, child, active)) return false;
    } while (kAll);
    pending_ = pending;
    child_ = child;
    active_ = active;
    return true;
  }

 private:
  /// More rays are worth a look at the hull of all before boxes are tested, and at a row's triangles for all.
  static constexpr std::uint32_t kFewForBoxes = 5, kFewForRows = 7;

  /// Some rays and a row whose box they meet.
  struct MetLeaf {
    const TriangleRows* rows;
    std::uint32_t lanes;
    float reach;
  };

  /// The next node that some ray goes to. False if there is none.
  HWY_INLINE bool pop(std::uint32_t& pending, std::uint32_t& child, std::uint32_t& active) {
    do {
      if (pending == 0) {
        answer_.finish();
        return false;
      }
      child = children_[--pending];
      active = rays_of_[pending] & answer_.open();
    } while (active == 0);
    return true;
  }

  /// Puts the inner children that are met onto the stack, the first last. Returns the lanes of the leaves.
  HWY_INLINE std::uint32_t push_inner(const FoldedNode& node, const RaysByBox& rays, std::uint32_t& pending) {
    const RayTag f;
    const hn::RebindToUnsigned<RayTag> n;
    const auto is_inner = [&](auto child) { return hn::Eq(hn::And(child, hn::Set(n, BvhNode::kLeaf)), hn::Zero(n)); };
    std::uint32_t leaves = 0;
    for (std::uint32_t i = kRowLanes; i > 0;) {
      i -= static_cast<std::uint32_t>(hn::Lanes(n));
      const auto child = hn::Load(n, node.child + i), met = hn::Load(n, rays.of + i), none = hn::Zero(n);
      leaves |= ray_bits(hn::RebindMask(f, hn::AndNot(is_inner(child), hn::Ne(met, none)))) << i;
      const auto child_back = hn::Reverse(n, child), met_back = hn::Reverse(n, met);
      const auto goes_on = hn::And(hn::Ne(met_back, none), is_inner(child_back));
      hn::StoreU(compress(met_back, goes_on), n, rays_of_ + pending);
      hn::StoreU(compress(child_back, goes_on), n, children_ + pending);
      pending += static_cast<std::uint32_t>(hn::CountTrue(n, goes_on));
    }
    return leaves;
  }

  /// Which boxes are crossed by which of the `active` rays.
  HWY_INLINE void cross(const BundleHull& hull, const FoldedNode& node, std::uint32_t active, Faces& faces,
                        RaysByBox& rays) const {
    const std::uint32_t count = count_ones(active);
    if (count <= kFewForBoxes) {
      hull.see(node.lower, node.upper, faces);
      times_.by_rays(faces, active, rays);
      return;
    }
    const std::uint32_t boxes = hull.meets(node.lower, node.upper, faces);
    if (count_ones(boxes) <= count)
      times_.by_boxes(faces, boxes, active, rays);
    else
      times_.by_rays(faces, active, rays);
  }
  static std::uint32_t count_ones(std::uint32_t bits) { return static_cast<std::uint32_t>(hwy::PopCount(bits)); }

  HWY_INLINE void meet(const BundleView& view, const TriangleRows& rows, std::uint32_t active, float reach) {
    if (count_ones(active) > kFewForRows)
      answer_.meet(view, rows, 0xFFFF, reach);
    else
      answer_.meet_alone(walk_rays_, active, rows, reach);
  }

  const SceneView& scene_;
  const GroupRays& rays_;
  BundleAnswer answer_;
  WalkRays walk_rays_;
  BundleTimes times_;
  std::optional<BundleHull> hull_;
  std::optional<BundleView> view_;
  MetLeaf leaves_[kRowLanes];  ///< of the last node
  std::uint32_t leaf_count_ = 0;
  std::uint32_t child_ = 0, active_ = 0;  ///< the next node, and the rays that go there
  // The stack: children, and which rays go there; with room for a vector beyond it.
  static constexpr std::uint32_t kMostPending = (kRowLanes - 1) * kMaxBvhDepth + 1 + kRowLanes;
  std::uint32_t pending_ = 0;
  std::uint32_t children_[kMostPending], rays_of_[kMostPending];
};

/// Bundles that walk by themselves: in a large scene some by turns, as what one needs next is fetched while others
/// walk.
class BundleWalks {
 public:
  BundleWalks(const SceneView& scene, const GroupRays& rays)
      : turns_(scene.bvh->bytes() < kNearBytes ? 1 : kMostTurns) {
    for (std::uint32_t i = 0; i < turns_; ++i) walks_[i].emplace(scene, rays);
  }

  /// Answers the bundles named, those that start far off by other(first, count).
  template <class Other>
  void trace(const std::vector<RayBundle>& bundles, const std::vector<std::uint32_t>& names, Other&& other) {
    std::size_t next = 0;
    const auto begin = [&](BundleWalk& walk) {
      while (next < names.size()) {
        const RayBundle& bundle = bundles[names[next++]];
        if (walk.start(bundle)) return true;
        other(bundle.first, bundle.count);
      }
      return false;
    };
    if (turns_ == 1) {
      while (begin(*walks_[0])) walks_[0]->template step<true>();
      return;
    }
    BundleWalk* walking[kMostTurns];
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < turns_; ++i)
      if (begin(*walks_[i])) walking[count++] = &*walks_[i];
    for (std::uint32_t i = 0; count > 0; i = i + 1 < count ? i + 1 : 0) {
      if (walking[i]->template step<false>() || begin(*walking[i])) continue;
      walking[i] = walking[--count];
    }
  }

 private:
  static constexpr std::uint32_t kMostTurns = 6;
  /// Where caches hold the hierarchy there is nothing to wait for.
  static constexpr std::uint64_t kNearBytes = std::uint64_t{128} << 20;

  std::uint32_t turns_;
  std::optional<BundleWalk> walks_[kMostTurns];  ///< so many of them
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
