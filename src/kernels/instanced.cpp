// SPDX-License-Identifier: Apache-2.0
// A ray at a time, in two levels: boxes of instances in the world, then for each that it meets the boxes of its
// prototype, in the prototype's space. Triangles are placed in the world before they are tested, where the ray is what
// it was: so answers are those for the placed mesh.
#include "kernels/instanced.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/instanced.cpp"

#include <hwy/foreach_target.h>  // compiles this file once for each instruction set
#include <hwy/highway.h>

#include "kernels/instance_leaf-inl.h"
#include "kernels/local_ray-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {
namespace {

/// For one ray and what it sees. Needs a valid ray.
class InstanceQuery {
 public:
  InstanceQuery(const InstanceTree& tree, const Ray& ray, const QueryOptions& options, std::size_t index)
      : tree_(tree), ray_(ray), world_(ray), mask_(options.mask) {
    if (options.skip) skip_ = options.skip[index];
  }

  const Ray& ray() const { return ray_; }

  /// Calls visit(instance, triangle, its number) for all that the ray may hit before `limit`, until it returns true.
  template <class Visit, class Counts>
  HWY_INLINE bool walk(const double& limit, Visit&& visit, Counts& counts) const {
    const LocalRay local(world_, tree_.frame(), limit);
    const auto instances = [&](const TriangleRows& boxes, double) {
      CrossedBoxes<double, kRowLanes> crossed;
      local.cross(boxes, crossed);
      for (std::uint32_t rest = crossed.lanes; rest != 0; rest &= rest - 1) {
        const std::uint32_t lane = lane_of(rest);
        if (crossed.t0[lane] > limit) continue;
        const PlacedInstance& instance = tree_.instance(boxes.id[lane]);
        if ((instance.mask & mask_) != 0 && walk_prototype(instance, limit, visit, counts)) return true;
      }
      return false;
    };
    return bvh_walk(tree_.boxes(), local, limit, instances, counts);
  }

 private:
  template <class Visit, class Counts>
  HWY_INLINE bool walk_prototype(const PlacedInstance& instance, const double& limit, Visit& visit,
                                 Counts& counts) const {
    const InstanceLeaf leaf(instance, world_);
    const std::uint32_t skip = skip_.mesh == instance.mesh ? skip_.triangle : Primitive::kNone;
    const auto rows = [&](const TriangleRows& triangles, double) {
      counts.primitives(triangles.count);
      for (std::uint32_t rest = leaf.candidates(triangles, limit); rest != 0; rest &= rest - 1) {
        const std::uint32_t lane = lane_of(rest), id = triangles.id[lane];
        if (id != skip && visit(instance, placed_triangle(instance, triangles, lane), id)) return true;
      }
      return false;
    };
    return bvh_walk(tree_.prototype(instance.prototype).bvh(), LocalRay(world_, instance.frame, limit), limit, rows,
                    counts);
  }

  const InstanceTree& tree_;
  const Ray& ray_;
  WorldRay world_;
  std::uint32_t mask_;
  Primitive skip_;
};

bool is_opaque(const PlacedInstance& instance, std::uint32_t triangle, const HitParameters& at) {
  return !instance.opacity.opaque ||
         instance.opacity.opaque(instance.opacity.user, triangle, static_cast<float>(at.u), static_cast<float>(at.v));
}

template <class Counts>
bool is_occluded(const InstanceQuery& query, Counts& counts) {
  const auto blocks = [&](const PlacedInstance& instance, const Triangle& triangle, std::uint32_t id) {
    if (!instance.opacity.opaque) return hits(query.ray(), triangle, counts);
    OrderedHit hit{};
    return hits(query.ray(), triangle, hit, counts) && is_opaque(instance, id, hit.parameters);
  };
  const double limit = query.ray().tmax;
  return query.walk(limit, blocks, counts);
}

/// The closest hit so far, in a triangle of the scene or of an instance.
class NearestPlaced {
 public:
  NearestPlaced(const SceneView& scene, const Ray& ray, const Hit& hit) : ray_(ray), limit_(ray.tmax) {
    if (!hit.valid()) return;
    const Triangle& triangle =
        scene.triangles[scene.meshes[hit.primitive.mesh].first_triangle + hit.primitive.triangle];
    OrderedHit again{};
    NoCounts none;
    if (hits(ray, triangle, again, none)) set(hit.primitive, triangle, again);
  }

  /// Beyond it nothing comes first.
  const double& limit() const { return limit_; }

  template <class Counts>
  void offer(const PlacedInstance& instance, const Triangle& triangle, std::uint32_t id, Counts& counts) {
    OrderedHit hit{};
    if (!hits(ray_, triangle, hit, counts) || !is_opaque(instance, id, hit.parameters)) return;
    const Primitive primitive{instance.mesh, id};
    if (found_ && !comes_before(ray_, hit, triangle, order_of(primitive), hit_, triangle_, order_of(primitive_)))
      return;
    set(primitive, triangle, hit);
    is_placed_ = true;
  }

  /// Is it an instance's?
  bool is_placed() const { return is_placed_; }
  Hit hit() const {
    return {static_cast<float>(hit_.parameters.t), static_cast<float>(hit_.parameters.u),
            static_cast<float>(hit_.parameters.v), primitive_};
  }

 private:
  /// Meshes in the order in which they were added.
  static std::uint64_t order_of(const Primitive& p) { return std::uint64_t{p.mesh} << 32 | p.triangle; }

  void set(const Primitive& primitive, const Triangle& triangle, const OrderedHit& hit) {
    found_ = true;
    primitive_ = primitive;
    triangle_ = triangle;
    hit_ = hit;
    limit_ = std::min(static_cast<double>(ray_.tmax), hit.t_high);
  }

  const Ray& ray_;
  double limit_;
  bool found_ = false, is_placed_ = false;
  Primitive primitive_;
  Triangle triangle_{};
  OrderedHit hit_{};
};

template <class Counts>
void find_closest(const InstanceTree& tree, const SceneView& scene, const Ray& ray, const QueryOptions& options,
                  std::size_t index, Hit& out, Counts& counts) {
  const InstanceQuery query(tree, ray, options, index);
  NearestPlaced nearest(scene, ray, out);
  const auto offer = [&](const PlacedInstance& instance, const Triangle& triangle, std::uint32_t id) {
    nearest.offer(instance, triangle, id, counts);
    return false;
  };
  query.walk(nearest.limit(), offer, counts);
  if (nearest.is_placed()) out = nearest.hit();
}

void occluded(const InstanceTree& tree, RaySpan rays, std::uint8_t* out, const QueryOptions& options) {
  NoCounts none;
  for (std::size_t i = 0; i < rays.count; ++i)
    if (out[i] == 0 && is_valid(rays[i])) out[i] = is_occluded(InstanceQuery(tree, rays[i], options, i), none);
}

void occluded_counted(const InstanceTree& tree, RaySpan rays, std::uint8_t* out, const QueryOptions& options,
                      RayCounts* each) {
  for (std::size_t i = 0; i < rays.count; ++i) {
    CountEach counts;
    counts.counts.rays = 0;  // it was counted before
    if (out[i] == 0 && is_valid(rays[i])) out[i] = is_occluded(InstanceQuery(tree, rays[i], options, i), counts);
    each[i] = counts.counts;
  }
}

void closest(const InstanceTree& tree, const SceneView& scene, RaySpan rays, Hit* out, const QueryOptions& options,
             RayCounts* sum) {
  NoCounts none;
  CountEach counts;
  counts.counts.rays = 0;
  for (std::size_t i = 0; i < rays.count; ++i) {
    if (!is_valid(rays[i])) continue;
    if (sum)
      find_closest(tree, scene, rays[i], options, i, out[i], counts);
    else
      find_closest(tree, scene, rays[i], options, i, out[i], none);
  }
  if (sum) *sum += counts.counts;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace umbrix::detail {
namespace {

HWY_EXPORT(occluded);
HWY_EXPORT(occluded_counted);
HWY_EXPORT(closest);

}  // namespace

void add_instances(const InstanceTree& tree, RaySpan rays, std::uint8_t* out, const QueryOptions& options,
                   RayCounts* each) noexcept {
  const DefaultFloatMode mode;
  if (each)
    HWY_DYNAMIC_DISPATCH(occluded_counted)(tree, rays, out, options, each);
  else
    HWY_DYNAMIC_DISPATCH(occluded)(tree, rays, out, options);
}

void add_instances(const InstanceTree& tree, RaySpan rays, std::uint8_t* out, QueryOptions options,
                   OcclusionCounts& counts) noexcept {
  constexpr std::size_t kMost = 64;
  RayCounts each[kMost];
  std::uint8_t before[kMost];
  for (std::size_t begin = 0; begin < rays.count; begin += kMost) {
    const std::size_t count = std::min(kMost, rays.count - begin);
    std::copy(out + begin, out + begin + count, before);
    add_instances(tree, RaySpan{&rays[begin], count, rays.stride}, out + begin, options, each);
    for (std::size_t i = 0; i < count; ++i) {
      if (before[i] != 0) continue;
      const bool blocked = out[begin + i] != 0;
      (blocked ? counts.occluded : counts.unoccluded) += each[i];
      counts.occluded.rays += blocked ? 1 : 0;
      counts.unoccluded.rays -= blocked ? 1 : 0;
    }
    if (options.skip) options.skip += count;
  }
}

void add_closest_instances(const InstanceTree& tree, const SceneView& scene, RaySpan rays, Hit* out,
                           const QueryOptions& options, RayCounts* counts) noexcept {
  const DefaultFloatMode mode;
  HWY_DYNAMIC_DISPATCH(closest)(tree, scene, rays, out, options, counts);
}

}  // namespace umbrix::detail
#endif
