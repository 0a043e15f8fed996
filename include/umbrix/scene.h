// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "umbrix/executor.h"
#include "umbrix/export.h"
#include "umbrix/instance.h"
#include "umbrix/kernel.h"
#include "umbrix/mesh.h"
#include "umbrix/ray.h"
#include "umbrix/stats.h"
#include "umbrix/status.h"

namespace umbrix {

namespace detail {
struct SceneAccess;
}

/// How much time the tree may take.
enum class BuildQuality {
  high,  ///< exact surface area heuristic, triangles clipped to cells (Wald & Havran 2006)
  fast,  ///< binned heuristic on clipped boxes: for previews
};

/// When the tree is built. A scene always has a hierarchy of boxes, which is built much sooner, and which most rays of
/// the default kernel want alone.
enum class TreeBuild {
  on_demand,  ///< when a query or Scene::prepare first needs it: that one query takes longer
  at_commit,
};

struct BuildOptions {
  BuildQuality quality = BuildQuality::high;  ///< of the tree
  const Executor* executor = nullptr;         ///< of commit; a query that builds the tree uses oneTBB. Null: oneTBB
  TreeBuild tree = TreeBuild::on_demand;
};

/// What a query sees and how it is answered.
struct QueryOptions {
  std::uint32_t mask = 0xFFFFFFFFu;  ///< meshes with (mesh mask & mask) == 0 are not there
  const Primitive* skip = nullptr;   ///< one for each ray: a triangle that is not there for that ray; or null
  KernelId kernel;                   ///< default: the recommended one
  /// Shares calls of many rays among its threads; Executor{} is oneTBB. Null, and where work is counted: the thread
  /// that calls does all.
  const Executor* executor = nullptr;
};

/// Rays like those to come, for kernels that learn from them. Others use the executor only.
struct Training {
  RaySpan rays;
  const Primitive* skip = nullptr;     ///< as in QueryOptions
  const float (*lights)[3] = nullptr;  ///< where the rays go to, for links made from the lights on
  std::size_t light_count = 0;
  const Executor* executor = nullptr;  ///< null: oneTBB
};

/// What Scene::prepare made and what it cost.
struct PrepareStats {
  double seconds = 0;
  std::uint64_t bytes = 0;
};

/// Triangles and what rays walk to find them: a hierarchy of boxes, and from when it is needed a KD-tree. Add meshes,
/// commit once, then ask.
///
/// Answers are those of real arithmetic for the float rays and float vertices: a ray hits a triangle if some
/// t with tmin < t < tmax lies on it, edges and vertices included. A ray within a triangle's plane does not
/// hit it. Every kernel, instruction set and thread count gives the same answers.
///
/// Thread-safety: add and commit from one thread; after commit, queries from any number of threads.
/// No call throws. Queries before commit see nothing.
class UMBRIX_API Scene {
 public:
  Scene() noexcept;
  ~Scene();
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// Copies a mesh in; `*mesh`, if given, receives its number (0, 1, ... in order).
  /// invalid_argument: null or misaligned data, an index out of range, a scene already committed.
  /// resource_limit: no memory, or more than 2^29 triangles.
  Status add(const MeshView& mesh, std::uint32_t* mesh_id = nullptr);

  /// Copies in a mesh that is seen through its instances alone; `*prototype_id`, if given, receives its number, which
  /// is none of a mesh. Its mask and opacity do not count. Fails as add does; each prototype may have 2^29 triangles.
  Status add_prototype(const MeshView& mesh, std::uint32_t* prototype_id = nullptr);

  /// Adds a prototype's mesh with its vertices moved by transform_point: all answers are, bit for bit, those that add
  /// would give for them. It takes the next number of a mesh; Primitive, skip, mask and opacity go by it. But its
  /// triangles take no memory of their own, unless the transform has no inverse to speak of, or moves so far that float
  /// leaves little of the shape: then they are added as a mesh's. Rays take longer (docs/instances.md): it pays for
  /// large meshes that are used again and again.
  /// invalid_argument: no such prototype, a scene already committed. resource_limit: no memory, 2^29 instances, or too
  /// many triangles where they have to be added.
  Status add_instance(const Instance& instance, std::uint32_t* mesh_id = nullptr);

  /// Makes all that an ordinary frame of the default kernel needs; the tree too if the options say so. resource_limit:
  /// no memory; the scene then stays empty.
  Status commit(const BuildOptions& options = {});

  /// Moves instances and reshapes prototypes of a committed scene: all answers are then those of a scene that was built
  /// so. What is no instance stays as it was built, and so does what kernels and frame tracers remember of it. Not
  /// while queries run, or within a frame. The scene is as before if it fails. invalid_argument: no such instance or
  /// prototype; or an instance cannot stay one where it goes, or has not become one (add_instance): only a new scene
  /// has it there. resource_limit: no memory.
  Status update(const SceneUpdate& update);

  /// Builds the tree if the kernel can use it, and makes what the kernel needs beside it
  /// (KernelInfo::needs_preparation), in place of what it had. Answers do not depend on it: queries build the tree
  /// themselves, and do without if there is no memory. After commit, and not while queries run. invalid_argument: not
  /// committed. resource_limit: no memory; the kernel then walks as "standard" does, or without the tree as "bvh" does.
  Status prepare(KernelId kernel, const Training& training = {}, PrepareStats* stats = nullptr);

  /// What a kernel holds beside the tree now, after growing as rays wanted it; 0 if it was not prepared.
  std::uint64_t prepared_bytes(KernelId kernel) const noexcept;

  /// Is something between the ray's ends?
  bool occluded(const Ray& ray, const QueryOptions& options = {}) const noexcept;

  /// The same for many rays: out[i] is 1 if rays[i] is occluded, else 0.
  void occluded(RaySpan rays, std::uint8_t* out, const QueryOptions& options = {}) const noexcept;

  /// The hit with the smallest t; among equal t, of the triangle added first. Returns whether there is one.
  bool closest(const Ray& ray, Hit& hit, const QueryOptions& options = {}) const noexcept;
  void closest(RaySpan rays, Hit* out, const QueryOptions& options = {}) const noexcept;

  /// As above, and adds the work done to `counts`. Slower; answers are the same.
  void occluded(RaySpan rays, std::uint8_t* out, OcclusionCounts& counts,
                const QueryOptions& options = {}) const noexcept;
  void closest(RaySpan rays, Hit* out, RayCounts& counts, const QueryOptions& options = {}) const noexcept;

  /// What commit did, and with the tree's figures once it is built; zeros before.
  const BuildStats& build_stats() const noexcept;

  /// The box of the kept triangles (and of those without area in instances); false (and zeros) if there are none.
  bool bounds(float lower[3], float upper[3]) const noexcept;

 private:
  friend struct detail::SceneAccess;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// A ray origin for a point on a triangle, displaced along the normal on the side of `toward`, far enough that the
/// rounding of the point cannot put it behind the triangle (after Pharr, Jakob & Humphreys 2023, section 6.8.6).
/// `point_error` bounds the point's absolute error per axis; `normal` is the geometric one, any length.
UMBRIX_API void offset_origin(const float point[3], const float point_error[3], const float normal[3],
                              const float toward[3], float origin[3]) noexcept;

}  // namespace umbrix
