// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "core/float_mode.h"
#include "index/triangle_bvh.h"
#include "kernels/ray_class.h"
#include "kernels/scene_view.h"

namespace umbrix::detail {

/// The walk for rays that float cannot place well enough: origins more than four extents outside the scene, and values
/// out of float's comfortable range. Plane times are in double, whose error stays below the tree's eps up to 2^30
/// extents; beyond, every triangle is tested. Slow, rare, and right.
class FarRay {
 public:
  FarRay(const SceneView& scene, const Ray& ray) noexcept : scene_(scene) {
    const Tree& tree = *scene.tree;
    const double position_scale = std::ldexp(1.0, tree.scale_exponent);
    double largest = 0;
    for (int k = 0; k < 3; ++k) largest = std::max(largest, std::abs(static_cast<double>(ray.direction[k])));
    int direction_exponent = 0;
    std::frexp(largest, &direction_exponent);
    const double direction_scale = std::ldexp(1.0, -direction_exponent);
    const double time_scale = std::ldexp(1.0, tree.scale_exponent + direction_exponent);
    const double too_far = 0x1p30 * static_cast<double>(tree.root.largest_extent());
    for (int k = 0; k < 3; ++k) {
      origin_[k] = ray.origin[k] * position_scale;
      const double d = ray.direction[k] * direction_scale;
      inverse_[k] = 1 / (std::abs(d) < 0x1p-64 ? std::copysign(0x1p-64, d) : d);
      beyond_double_ |= std::abs(origin_[k] - static_cast<double>(tree.root.lower[k])) > too_far;
    }
    t0_ = ray.tmin * time_scale;
    t1_ = ray.tmax * time_scale;
  }

  /// Offers candidate triangles until visit(id) returns true; returns whether it did. By the hierarchy of boxes if one
  /// is given, else by the tree.
  template <class Visit, class Counts>
  bool visit_candidates(const TriangleBvh* boxes, Visit&& visit, Counts& counts) noexcept {
    counts.far_ray();
    if (beyond_double_) return visit_all(visit, counts);
    if (!boxes) return walk(visit, counts);
    return !boxes->empty() && visit_node(*boxes, 0, visit, counts);
  }

 private:
  double plane_time(float plane, int axis) const noexcept {
    return (static_cast<double>(plane) - origin_[axis]) * inverse_[axis];
  }

  template <class Visit, class Counts>
  bool visit_all(Visit& visit, Counts& counts) const noexcept {
    for (std::size_t i = 0; i < scene_.kept_count; ++i) {
      counts.primitives(1);
      if (visit(scene_.kept[i])) return true;
    }
    return false;
  }

  template <class Visit, class Counts>
  bool visit_leaf(const Node& leaf, Visit& visit, Counts& counts) const noexcept {
    for (std::uint32_t b = 0; b < leaf.block_count(); ++b) {
      const Block& block = scene_.tree->blocks[leaf.first_block() + b];
      counts.primitives(block.count);
      for (std::uint32_t lane = 0; lane < block.count; ++lane)
        if (visit(block.id[lane])) return true;
    }
    return false;
  }

  bool crosses(const BvhNode& node, std::uint32_t lane) const noexcept {
    double t0 = t0_, t1 = t1_;
    for (int axis = 0; axis < 3; ++axis) {
      const double low = plane_time(node.lower[axis][lane], axis), high = plane_time(node.upper[axis][lane], axis);
      t0 = std::max(t0, inverse_[axis] < 0 ? high : low);
      t1 = std::min(t1, inverse_[axis] < 0 ? low : high);
    }
    return t0 <= t1;
  }

  /// No deeper than the hierarchy.
  template <class Visit, class Counts>
  bool visit_node(const TriangleBvh& bvh, std::uint32_t index, Visit& visit, Counts& counts) const noexcept {
    const BvhNode& node = bvh.node(index);
    counts.node();
    for (std::uint32_t lane = 0; lane < kBvhWidth; ++lane) {
      if (!crosses(node, lane)) continue;
      if ((node.child[lane] & BvhNode::kLeaf) == 0) {
        if (visit_node(bvh, node.child[lane], visit, counts)) return true;
        continue;
      }
      const TriangleRows& rows = bvh.rows(node.child[lane] & ~BvhNode::kLeaf);
      counts.node();
      counts.leaf();
      counts.primitives(rows.count);
      for (std::uint32_t i = 0; i < rows.count; ++i)
        if (visit(rows.id[i])) return true;
    }
    return false;
  }

  template <class Visit, class Counts>
  bool walk(Visit& visit, Counts& counts) noexcept {
    const Box& root = scene_.tree->root;
    for (int k = 0; k < 3; ++k) {
      const double low = plane_time(root.lower[k], k), high = plane_time(root.upper[k], k);
      t0_ = std::max(t0_, std::min(low, high));
      t1_ = std::min(t1_, std::max(low, high));
    }
    if (!(t0_ <= t1_)) return false;
    struct Pending {
      std::uint32_t node;
      double t1;
    };
    Pending stack[kMaxDepth + 1];
    std::uint32_t pending = 0, index = 0;
    for (;;) {
      const Node& node = scene_.tree->nodes[index];
      counts.node();
      if (!node.is_leaf()) {
        const int axis = static_cast<int>(node.axis_bits());
        const double t = plane_time(node.plane(), axis);
        const std::uint32_t near = node.low_child() + (inverse_[axis] < 0 ? 1u : 0u);
        if (t <= t0_ && t < t1_) {
          index = near ^ 1u;
        } else {
          if (t < t1_) {
            stack[pending++] = {near ^ 1u, t1_};
            t1_ = t;
          }
          index = near;
        }
        continue;
      }
      counts.leaf();
      if (visit_leaf(node, visit, counts)) return true;
      if (pending == 0) return false;
      --pending;
      t0_ = t1_;
      index = stack[pending].node;
      t1_ = stack[pending].t1;
    }
  }

  const SceneView& scene_;
  double origin_[3];
  double inverse_[3];
  double t0_ = 0, t1_ = 0;
  bool beyond_double_ = false;
};

template <class Counts>
bool far_occluded(const SceneView& scene, const Filter& filter, const Ray& ray, Counts& counts,
                  const TriangleBvh* boxes = nullptr) noexcept {
  const DefaultFloatMode mode;
  return FarRay(scene, ray)
      .visit_candidates(
          boxes, [&](std::uint32_t id) { return blocks(scene, filter, ray, id, counts); }, counts);
}

template <class Counts>
void far_closest(const SceneView& scene, const Filter& filter, const Ray& ray, Nearest& nearest, Counts& counts,
                 const TriangleBvh* boxes = nullptr) noexcept {
  const DefaultFloatMode mode;
  FarRay(scene, ray)
      .visit_candidates(
          boxes,
          [&](std::uint32_t id) {
            nearest.offer(scene, filter, ray, id, counts);
            return false;
          },
          counts);
}

}  // namespace umbrix::detail
