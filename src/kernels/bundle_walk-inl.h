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
    walk(hull, BundleView(bundle, hull));
    answer_.finish();
    return true;
  }

 private:
  /// More rays are worth a look at the hull of all before boxes are tested, and at a row's triangles for all.
  static constexpr std::uint32_t kFewForBoxes = 3, kFewForRows = 7;

  struct Pending {
    std::uint32_t child, rays;
  };

  void walk(const BundleHull& hull, const BundleView& view) {
    const FoldedBvh& bvh = *scene_.folded;
    Pending stack[(kRowLanes - 1) * kMaxBvhDepth + 1];
    std::uint32_t pending = 0;
    Pending here{0, answer_.open()};
    for (;;) {
      const FoldedNode& node = bvh.node(here.child);
      Faces faces;
      alignas(64) std::uint16_t rays[kRowLanes];  // by box
      Pending inner[kRowLanes];
      std::uint32_t inner_count = 0;
      for (std::uint32_t rest = cross(hull, node, here.rays, faces, rays); rest != 0; rest &= rest - 1) {
        const std::uint32_t lane = lane_of(rest), child = node.child[lane];
        if ((child & BvhNode::kLeaf) == 0)
          inner[inner_count++] = {child, rays[lane]};
        else
          meet(view, bvh.rows(child & ~BvhNode::kLeaf), rays[lane] & answer_.open(), faces.reach(lane));
      }
      while (inner_count > 0) stack[pending++] = inner[--inner_count];
      do {
        if (pending == 0) return;
        here = stack[--pending];
        here.rays &= answer_.open();
      } while (here.rays == 0);
    }
  }

  /// Which boxes are crossed, and by which of the `active` rays.
  HWY_INLINE std::uint32_t cross(const BundleHull& hull, const FoldedNode& node, std::uint32_t active, Faces& faces,
                                 std::uint16_t (&rays)[kRowLanes]) const {
    const std::uint32_t count = count_ones(active);
    if (count <= kFewForBoxes) {
      hull.see(node.lower, node.upper, faces);
      return times_.by_rays(faces, 0xFFFF, active, rays);
    }
    const std::uint32_t boxes = hull.meets(node.lower, node.upper, faces);
    return count_ones(boxes) <= count ? times_.by_boxes(faces, boxes, active, rays)
                                      : times_.by_rays(faces, boxes, active, rays);
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
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
