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
#include "tree/pack.h"
#include "tree/scale.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

class Candidates {
 public:
  /// More lanes cost no time, but each is a test: the last two blockers hold most of what the last eight do.
  static constexpr std::uint32_t kMost = 2;

  explicit Candidates(const SceneView& scene) : scene_(scene) {
    block_.count = 0;
    block_.edge_bound = 0;
    for (int k = 0; k < 3; ++k)
      farthest_ += std::max(std::abs(scene.tree->root.lower[k]), std::abs(scene.tree->root.upper[k]));
  }

  bool empty() const { return block_.count == 0; }
  std::uint32_t count() const { return block_.count; }

  /// Takes a triangle in, in place of the one that has been there longest.
  void add(std::uint32_t id) {
    if (!holds(id)) pack_lane(id, scaled(scene_.triangles[id], scene_.tree->scale_exponent), next_lane(), block_);
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
    float reach = farthest_;
    for (const float x : walk_ray.origin) reach += std::abs(x);
    return block_blocks(scene_, filter, ray, test, walk_ray, block_, reach, counts);
  }

 private:
  bool holds(std::uint32_t id) const {
    return std::find(block_.id, block_.id + block_.count, id) != block_.id + block_.count;
  }
  std::uint32_t next_lane() { return block_.count < kMost ? block_.count++ : next_++ % kMost; }

  const SceneView& scene_;
  float farthest_ = 0;  ///< 1-norm of no vertex is larger
  std::uint32_t next_ = 0;
  Block block_;
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
