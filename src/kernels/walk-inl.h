// SPDX-License-Identifier: Apache-2.0
// The conservative walk: plain float plane times and no epsilon, over cells that hold every triangle within eps.
// A true hit at t lies in the closed interval of some leaf the walk visits, up to 3 * 2^-24 of the distance from the
// origin to that leaf's planes; eps covers this for origins within four extents of the scene. One expression for each
// plane time, so that the same plane has the same time wherever it is met.

#if defined(UMBRIX_KERNELS_WALK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_WALK_INL_H_
#undef UMBRIX_KERNELS_WALK_INL_H_
#else
#define UMBRIX_KERNELS_WALK_INL_H_
#endif

#include <hwy/highway.h>

#include "kernels/ray_class.h"
#include "kernels/scene_view.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// x, y, z and one lane to spare.
using Lanes4 = hn::CappedTag<float, 4>;

/// A ray in the tree's units, its direction scaled so that the largest component is in [1, 2).
struct WalkRay {
  alignas(16) float origin[4];
  alignas(16) float direction[4];
  alignas(16) float inverse[4];
  std::uint32_t far_low[3];  ///< 1 if the ray goes down this axis: the low child is then the far one
  float tmin, tmax;
  float length;       ///< the direction's 1-norm
  double time_scale;  ///< a time in these units, by one in the ray's
};

/// How a valid ray is to be walked.
enum class Reach {
  near,  ///< origin within four extents of the scene: float plane times are good enough
  far,   ///< or out of float's comfortable range: see far_ray.h
};

/// No hit lies beyond: near origins are within 9 units of a scene of size 2, and no direction is shorter than 1.
inline constexpr double kTimeLimit = 256;

/// Origins within so much of the scene's box are near.
HWY_INLINE float near_margin(const Tree& tree) { return 4 * tree.root.largest_extent(); }

/// Could flush-to-zero lose a denormal value that matters in the tree's units?
inline bool has_denormals(const Ray& ray) {
  const float values[8] = {ray.origin[0],    ray.origin[1],    ray.origin[2],    ray.tmin,
                           ray.direction[0], ray.direction[1], ray.direction[2], ray.tmax};
  for (const float v : values)
    if (magnitude_bits(v) - 1u < kSmallestNormalBits - 1u) return true;
  return false;
}

/// Fills `out`; needs a valid ray.
HWY_INLINE Reach prepare(const Ray& ray, const Tree& tree, WalkRay& out) {
  const int direction_exponent = static_cast<int>(largest_magnitude_bits(ray.direction) >> 23) - 127;
  const int time_exponent = tree.scale_exponent + direction_exponent;
  if (direction_exponent < -126 || direction_exponent > 126 || tree.scale_exponent > 126 || tree.scale_exponent < -126)
    return Reach::far;
  if ((tree.scale_exponent > 6 || direction_exponent < -6 || time_exponent > 6) && has_denormals(ray))
    return Reach::far;

  const Lanes4 f;
  const auto position_scale = hn::Set(f, power_of_two(tree.scale_exponent));
  const auto direction_scale = hn::Set(f, power_of_two(-direction_exponent));
  const auto margin = hn::Set(f, near_margin(tree));
  const auto least = hn::Set(f, 0x1p-64f);
  const BoxLanes& root = tree.root_lanes;
  // The ray's floats in order: origin, tmin, direction, tmax. The spare lanes so hold tmin and tmax, which no one
  // reads.
  const float* const values = reinterpret_cast<const float*>(&ray);
  bool near = true;
  for (std::size_t k = 0; k < 4; k += hn::Lanes(f)) {
    const auto o = hn::Mul(hn::LoadU(f, values + k), position_scale);
    const auto d = hn::Mul(hn::LoadU(f, values + 4 + k), direction_scale);
    near &= hn::AllTrue(f, hn::And(hn::Ge(o, hn::Sub(hn::Load(f, root.lower + k), margin)),
                                   hn::Le(o, hn::Add(hn::Load(f, root.upper + k), margin))));
    // A component of (almost) zero gets a time beyond all others; the point moves by less than 2^-58.
    const auto slope = hn::IfThenElse(hn::Lt(hn::Abs(d), least), hn::CopySign(least, d), d);
    hn::Store(o, f, out.origin + k);
    hn::Store(d, f, out.direction + k);
    hn::Store(hn::Div(hn::Set(f, 1.0f), slope), f, out.inverse + k);
  }
  for (int k = 0; k < 3; ++k) out.far_low[k] = float_bits(out.inverse[k]) >> 31;
  out.length = std::abs(out.direction[0]) + std::abs(out.direction[1]) + std::abs(out.direction[2]);
  out.time_scale = power_of_two_double(time_exponent);
  out.tmin = static_cast<float>(std::clamp(ray.tmin * out.time_scale, -kTimeLimit, kTimeLimit));
  out.tmax = static_cast<float>(std::clamp(ray.tmax * out.time_scale, -kTimeLimit, kTimeLimit));
  return near ? Reach::near : Reach::far;
}

HWY_INLINE float plane_time(const WalkRay& ray, float plane, std::uint32_t axis) {
  return (plane - ray.origin[axis]) * ray.inverse[axis];
}

struct Interval {
  float t0, t1;
};

/// The part of the ray inside the tree's root. The ends are widened a little: a denormal one may have been rounded.
HWY_INLINE Interval clip_to_root(const WalkRay& ray, const Tree& tree) {
  const Lanes4 f;
  alignas(16) float entry[4], exit[4];
  for (std::size_t k = 0; k < 4; k += hn::Lanes(f)) {
    const auto origin = hn::Load(f, ray.origin + k), inverse = hn::Load(f, ray.inverse + k);
    const auto low = hn::Mul(hn::Sub(hn::Load(f, tree.root_lanes.lower + k), origin), inverse);
    const auto high = hn::Mul(hn::Sub(hn::Load(f, tree.root_lanes.upper + k), origin), inverse);
    hn::Store(hn::Min(low, high), f, entry + k);
    hn::Store(hn::Max(low, high), f, exit + k);
  }
  return {std::max(std::max(ray.tmin - 0x1p-100f, entry[0]), std::max(entry[1], entry[2])),
          std::min(std::min(ray.tmax + 0x1p-100f, exit[0]), std::min(exit[1], exit[2]))};
}

/// For walks that do nothing at inner nodes.
struct PassBy {
  HWY_INLINE bool operator()(std::uint32_t, float) const { return false; }
};

/// Visits the leaves that the interval crosses below a node, near first, with far children on a stack: leaf(run, t0,
/// t1) returns true to stop, and so may inner(node, t0), called for each inner node entered. `limit` is read before
/// each subtree: what starts beyond it is left out.
template <class Leaf, class Counts, class Inner = PassBy>
HWY_INLINE bool stack_walk(const Tree& tree, std::uint32_t index, Interval at, const WalkRay& ray, const float& limit,
                           Leaf&& leaf, Counts& counts, const Inner& inner = Inner()) {
  struct Pending {
    std::uint32_t node;
    float t1;
  };
  Pending stack[kMaxDepth + 1];
  std::uint32_t pending = 0;
  const Node* const nodes = tree.nodes.data();
  for (;;) {
    // Descend to the leaf at the start of the interval.
    Node node = nodes[index];
    counts.node();
    while (!node.is_leaf()) {
      if (inner(index, at.t0)) return true;
      const std::uint32_t axis = node.axis_bits();
      const float t = plane_time(ray, node.plane(), axis);
      const std::uint32_t near = node.low_child() + ray.far_low[axis];
      const std::uint32_t far = near ^ 1u;
      if (t >= at.t1) {
        index = near;
      } else if (t <= at.t0) {
        index = far;
      } else {
        stack[pending++] = {far, at.t1};
        at.t1 = t;
        index = near;
      }
      node = nodes[index];
      counts.node();
    }
    counts.leaf();
    if (node.block_count() != 0 && leaf(node.blocks(), at.t0, at.t1)) return true;
    if (pending == 0) return false;
    at.t0 = at.t1;
    if (at.t0 > limit) return false;
    --pending;
    index = stack[pending].node;
    at.t1 = stack[pending].t1;
  }
}

/// From the root.
struct StackWalk {
  using State = NoState;
  static constexpr bool kNearFirst = true;

  template <class Leaf, class Counts>
  static HWY_INLINE bool walk(const SceneView& scene, State&, const WalkRay& ray, const float& limit, Leaf&& leaf,
                              Counts& counts) {
    const Interval at = clip_to_root(ray, *scene.tree);
    return at.t0 <= at.t1 && stack_walk(*scene.tree, 0, at, ray, limit, leaf, counts);
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
