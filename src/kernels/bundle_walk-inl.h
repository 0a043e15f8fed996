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

#include "index/folded_bvh.h"
#include "kernels/bundle_answer-inl.h"
#include "kernels/bundle_hull-inl.h"
#include "kernels/bundle_times-inl.h"
#include "kernels/compress-inl.h"
#include "kernels/walk_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

class BundleWalk {
 public:
  BundleWalk(const SceneView& scene, const GroupRays& rays) : scene_(scene), rays_(rays), answer_(scene, rays) {}

  /// Marks the rays that are blocked. False, with none marked, if they start far off.
  bool trace(const RayBundle& bundle) {
    if (!walk_rays_.prepare(rays_.rays, bundle, *scene_.tree)) return false;
    times_.set(bundle);
    answer_.start(bundle);
    const BundleHull hull(bundle);
    walk(hull, BundleView(bundle));
    answer_.finish();
    return true;
  }

 private:
  /// More rays are worth a look at the hull of all before boxes are tested, and at a row's triangles for all.
  static constexpr std::uint32_t kFewForBoxes = 5, kFewForRows = 7;

  void walk(const BundleHull& hull, const BundleView& view) {
    const FoldedBvh& bvh = *scene_.folded;
    std::uint32_t pending = 0, child = 0, active = answer_.open();
    for (;;) {
      const FoldedNode& node = bvh.node(child);
      Faces faces;
      RaysByBox rays;
      cross(hull, node, active, faces, rays);
      const std::uint32_t leaves = push_inner(node, rays, pending);
      if (pending > 0) prefetch_lines(&bvh.node(children_[pending - 1]), sizeof node);
      for (std::uint32_t rest = leaves; rest != 0; rest &= rest - 1) {
        const std::uint32_t lane = lane_of(rest);
        meet(view, bvh.rows(node.child[lane] & ~BvhNode::kLeaf), rays.of[lane] & answer_.open(), faces.reach[lane]);
      }
      do {
        if (pending == 0) return;
        child = children_[--pending];
        active = rays_of_[pending] & answer_.open();
      } while (active == 0);
    }
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
  // The stack: children, and which rays go there; with room for a vector beyond it.
  static constexpr std::uint32_t kMostPending = (kRowLanes - 1) * kMaxBvhDepth + 1 + kRowLanes;
  std::uint32_t children_[kMostPending], rays_of_[kMostPending];
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
