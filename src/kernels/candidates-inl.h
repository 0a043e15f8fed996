// SPDX-License-Identifier: Apache-2.0
// Triangles that may well block the next ray, as one block: what blocked rays nearby (Haines & Greenberg 1986, "The light
// buffer", section on shadow caches).

#if defined(UMBRIX_KERNELS_CANDIDATES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_CANDIDATES_INL_H_
#undef UMBRIX_KERNELS_CANDIDATES_INL_H_
#else
#define UMBRIX_KERNELS_CANDIDATES_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>

#include "kernels/tree_kernel-inl.h"
#include "tree/block.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

class Candidates {
 public:
  /// More lanes cost no time, but each is a test: the last two blockers hold most of what the last eight do.
  static constexpr std::uint32_t kMost = 2;

  explicit Candidates(const SceneView& scene) : scene_(scene) {
    // No ray comes here in scenes whose scale is beyond float's (see prepare).
    scale_ = power_of_two(std::clamp(scene.tree->scale_exponent, -126, 126));
    block_.count = 0;
    block_.edge_bound = 0;
  }

  bool empty() const { return block_.count == 0; }
  std::uint32_t count() const { return block_.count; }

  /// Takes a triangle in, in place of the one that has been there longest.
  void add(std::uint32_t id) {
    if (holds(id)) return;
    Triangle triangle = scene_.triangles[id];
    for (Vec3& v : triangle.v) v *= scale_;
    pack_lane(id, triangle, next_lane(), block_);
  }

  /// The same for one that has just been tested, and so is at hand.
  void add(const Block& from, std::uint32_t lane) {
    if (holds(from.id[lane])) return;
    const std::uint32_t to = next_lane();
    for (int k = 0; k < 3; ++k) {
      block_.v0[k][to] = from.v0[k][lane];
      block_.e1[k][to] = from.e1[k][lane];
      block_.e2[k][to] = from.e2[k][lane];
    }
    block_.id[to] = from.id[lane];
    block_.edge_bound = std::max(block_.edge_bound, from.edge_bound);
  }

  template <class Counts>
  HWY_INLINE bool block(const Filter& filter, const Ray& ray, const LeafTest& test, const WalkRay& walk_ray,
                        Counts& counts) const {
    counts.indexed(block_.count);
    float reach = 0;
    for (std::uint32_t lane = 0; lane < block_.count; ++lane) {
      const float distance = std::abs(walk_ray.origin[0] - block_.v0[0][lane]) +
                             std::abs(walk_ray.origin[1] - block_.v0[1][lane]) +
                             std::abs(walk_ray.origin[2] - block_.v0[2][lane]);
      reach = std::max(reach, distance);
    }
    reach *= 1 + 0x1p-20f;  // the sum's own rounding
    return block_blocks(scene_, filter, ray, test, walk_ray, block_, reach, counts);
  }

 private:
  bool holds(std::uint32_t id) const {
    return std::find(block_.id, block_.id + block_.count, id) != block_.id + block_.count;
  }
  std::uint32_t next_lane() { return block_.count < kMost ? block_.count++ : next_++ % kMost; }

  const SceneView& scene_;
  float scale_;
  std::uint32_t next_ = 0;
  Block block_;
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
