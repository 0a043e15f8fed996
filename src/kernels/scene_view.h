// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "core/triangle_test.h"
#include "index/folded_bvh.h"
#include "index/side_table.h"
#include "index/triangle_bvh.h"
#include "kernels/counts.h"
#include "tree/lazy_tree.h"
#include "umbrix/mesh.h"
#include "umbrix/scene.h"

namespace umbrix::detail {

/// A mesh's share of the scene's flat list of triangles.
struct MeshRecord {
  std::uint32_t first_triangle;
  std::uint32_t triangle_count;
  std::uint32_t mask;
  OpacityTest opacity;
};

/// Everything a kernel may read. Triangles are named by their place in the flat list.
struct SceneView {
  const Tree* tree;
  const Triangle* triangles;  ///< exact vertices
  const std::uint32_t* kept;  ///< the triangles that can be hit, ascending
  std::size_t kept_count;
  const std::uint32_t* mesh_of;  ///< by triangle
  const MeshRecord* meshes;
  std::size_t mesh_count;
  bool all_plain;                       ///< no mesh has a zero mask or an opacity test
  const SideTable* side = nullptr;      ///< of the kernel that is asked, if it was prepared
  const LazyTree* lazy_tree = nullptr;  ///< of kernels that do not need the tree: to be asked before its nodes are read
  const TriangleBvh* bvh = nullptr;
  const FoldedBvh* folded = nullptr;
};

class InstanceTree;

/// The inside of a scene, for what is built on it.
struct SceneAccess {
  /// Null before commit. As it stands until the scene is gone.
  static const SceneView* view(const Scene& scene) noexcept;
  /// What kernels do not see: to be asked after them (instanced.h). Null if there are none.
  static const InstanceTree* instances(const Scene& scene) noexcept;
  /// What the default kernel has of a committed scene; null if there was no memory for it.
  static std::shared_ptr<const SideTable> default_side(const Scene& scene) noexcept;
};

/// For kernels that answer each ray by itself.
struct NoState {
  explicit NoState(const SceneView&) {}
};

/// Which triangles are there for one ray.
class Filter {
 public:
  Filter(const SceneView& scene, std::uint32_t mask) noexcept
      : scene_(scene), mask_(mask), plain_(scene.all_plain && mask == 0xFFFFFFFFu) {}

  /// The triangle to leave out for the next ray.
  void set_skip(const Primitive& p) noexcept {
    skip_ = p.mesh < scene_.mesh_count && p.triangle < scene_.meshes[p.mesh].triangle_count
                ? scene_.meshes[p.mesh].first_triangle + p.triangle
                : Primitive::kNone;
  }

  /// Is every triangle there and opaque?
  bool passes_all() const noexcept { return plain_ && skip_ == Primitive::kNone; }

  bool admits(std::uint32_t id) const noexcept { return id != skip_ && (plain_ || (mask_of(id) & mask_) != 0); }

  /// Does this triangle block all rays that hit it, if it is there?
  bool is_solid(std::uint32_t id) const noexcept { return plain_ || !scene_.meshes[scene_.mesh_of[id]].opacity.opaque; }

  /// For a triangle that is hit: does it block there?
  bool is_opaque(const Ray& ray, std::uint32_t id) const noexcept {
    if (plain_) return true;
    const OpacityTest& test = scene_.meshes[scene_.mesh_of[id]].opacity;
    if (!test.opaque) return true;
    OrderedHit hit{};
    NoCounts none;  // the test was counted when the hit was found
    hits(ray, scene_.triangles[id], hit, none);
    return is_opaque(id, hit.parameters);
  }

  bool is_opaque(std::uint32_t id, const HitParameters& parameters) const noexcept {
    if (plain_) return true;
    const MeshRecord& mesh = scene_.meshes[scene_.mesh_of[id]];
    return !mesh.opacity.opaque ||
           mesh.opacity.opaque(mesh.opacity.user, id - mesh.first_triangle, static_cast<float>(parameters.u),
                               static_cast<float>(parameters.v));
  }

 private:
  std::uint32_t mask_of(std::uint32_t id) const noexcept { return scene_.meshes[scene_.mesh_of[id]].mask; }

  const SceneView& scene_;
  std::uint32_t mask_;
  std::uint32_t skip_ = Primitive::kNone;
  bool plain_;
};

/// The closest hit found so far.
struct Nearest {
  std::uint32_t id = Primitive::kNone;
  OrderedHit hit{};

  bool found() const noexcept { return id != Primitive::kNone; }

  /// Tests a triangle and keeps it if it comes first. Returns whether it was kept.
  template <class Counts>
  bool offer(const SceneView& scene, const Filter& filter, const Ray& ray, std::uint32_t candidate,
             Counts& counts) noexcept {
    if (candidate == id || !filter.admits(candidate)) return false;
    OrderedHit other;
    if (!hits(ray, scene.triangles[candidate], other, counts)) return false;
    if (!filter.is_opaque(candidate, other.parameters)) return false;
    if (found() && !comes_before(ray, other, scene.triangles[candidate], candidate, hit, scene.triangles[id], id))
      return false;
    id = candidate;
    hit = other;
    return true;
  }
};

/// Does this triangle block the ray? For tests that the float filter leaves open.
template <class Counts>
bool blocks(const SceneView& scene, const Filter& filter, const Ray& ray, std::uint32_t id, Counts& counts) noexcept {
  return filter.admits(id) && hits(ray, scene.triangles[id], counts) && filter.is_opaque(ray, id);
}

}  // namespace umbrix::detail
