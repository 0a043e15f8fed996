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

/// A ray in the tree's units, its direction scaled so that the largest component is in [1, 2).
struct WalkRay {
  float origin[3];
  float direction[3];
  float inverse[3];
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

  const float position_scale = power_of_two(tree.scale_exponent);
  const float direction_scale = power_of_two(-direction_exponent);
  const float margin = 4 * tree.root.largest_extent();
  bool near = true;
  out.length = 0;
  for (int k = 0; k < 3; ++k) {
    const float o = ray.origin[k] * position_scale;
    const float d = ray.direction[k] * direction_scale;
    near &= o >= tree.root.lower[k] - margin && o <= tree.root.upper[k] + margin;
    // A component of (almost) zero gets a time beyond all others; the point moves by less than 2^-58.
    const float slope = std::abs(d) < 0x1p-64f ? std::copysign(0x1p-64f, d) : d;
    out.origin[k] = o;
    out.direction[k] = d;
    out.inverse[k] = 1 / slope;
    out.far_low[k] = slope < 0 ? 1u : 0u;
    out.length += std::abs(d);
  }
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
HWY_INLINE Interval clip_to_root(const WalkRay& ray, const Box& root) {
  Interval result{ray.tmin - 0x1p-100f, ray.tmax + 0x1p-100f};
  for (std::uint32_t k = 0; k < 3; ++k) {
    const int axis = static_cast<int>(k);
    const float low = plane_time(ray, root.lower[axis], k);
    const float high = plane_time(ray, root.upper[axis], k);
    result.t0 = std::max(result.t0, std::min(low, high));
    result.t1 = std::min(result.t1, std::max(low, high));
  }
  return result;
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
    const Interval at = clip_to_root(ray, scene.tree->root);
    return at.t0 <= at.t1 && stack_walk(*scene.tree, 0, at, ray, limit, leaf, counts);
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
