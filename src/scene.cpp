// SPDX-License-Identifier: Apache-2.0
#include "umbrix/scene.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <new>
#include <optional>
#include <vector>

#include "core/exact_test.h"
#include "core/float_mode.h"
#include "core/growing_array.h"
#include "core/mesh_triangles.h"
#include "core/parallel_for.h"
#include "core/transform.h"
#include "index/instance_tree.h"
#include "kernels/instanced.h"
#include "kernels/kernel.h"
#include "kernels/ray_blocks.h"
#include "tree/lazy_tree.h"

namespace umbrix {

namespace detail {
extern const Kernel kBvhKernel;
}

// Hidden: the class that holds it is exported.
struct __attribute__((visibility("hidden"))) Scene::Impl {
  detail::GrowingArray<detail::Triangle> triangles;
  detail::GrowingArray<std::uint32_t> mesh_of;
  detail::GrowingArray<std::uint32_t> kept;
  std::vector<detail::MeshRecord> meshes;
  detail::Box bounds;
  detail::Box placed_bounds;  ///< without the instances
  detail::TriangleBvh bvh;
  detail::FoldedBvh folded;
  std::optional<detail::LazyTree> tree;  ///< from commit on
  detail::InstanceTree instances;        ///< those that stay instances
  BuildStats stats;
  detail::SceneView view{};
  std::vector<std::shared_ptr<const detail::SideTable>> side_tables;  ///< by the kernel's place in the table
  std::vector<bool> flattened;  ///< by prototype: whether an instance did not stay one
  bool committed = false;

  template <class TriangleAt>
  void append(std::size_t count, std::uint32_t mask, const OpacityTest& opacity, const TriangleAt& triangle_at);
  void keep_or_drop(const detail::Triangle& triangle, std::uint32_t id);
  void make_view();

  void build(const BuildOptions& options);
  void make_side_table(KernelId kernel, const Training& training);

  /// A kernel's queries, or if it needs a tree for which there is no memory, those that need none.
  const detail::EntryPoints& entry_points(KernelId kernel) const noexcept {
    const detail::Kernel& wanted = detail::kernel_at(kernel);
    return (wanted.needs_tree && !tree->need() ? detail::kBvhKernel : wanted).entry_points();
  }

  /// The scene as the kernel sees it, with its side table.
  detail::SceneView view_for(KernelId kernel) const noexcept {
    detail::SceneView result = view;
    const std::size_t place = detail::kernel_place(kernel);
    if (place < side_tables.size()) result.side = side_tables[place].get();
    return result;
  }
};

namespace {

constexpr std::uint64_t kMaxTriangles = 1ull << 29;
constexpr std::uint64_t kMaxInstances = 1ull << 29;

Status check_count(std::uint64_t triangles_so_far, std::uint64_t more) {
  if (triangles_so_far + more > kMaxTriangles) return {StatusCode::resource_limit, "scene: more than 2^29 triangles"};
  return {};
}

}  // namespace

Scene::Scene() noexcept = default;
Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

void Scene::Impl::keep_or_drop(const detail::Triangle& triangle, std::uint32_t id) {
  if (!detail::is_finite(triangle)) {
    ++stats.dropped_nonfinite;
  } else if (detail::is_degenerate(triangle)) {
    ++stats.dropped_degenerate;
  } else {
    kept.push_back(id);
    for (const detail::Vec3& v : triangle.v) bounds.extend(v);
  }
}

/// Adds a mesh's triangles to the list. Throws std::bad_alloc, and has then added nothing.
template <class TriangleAt>
void Scene::Impl::append(std::size_t count, std::uint32_t mask, const OpacityTest& opacity,
                         const TriangleAt& triangle_at) {
  // Ask for all memory first: nothing after it can fail half-way.
  triangles.make_room(count);
  kept.make_room(count);
  mesh_of.make_room(count);
  const auto first = static_cast<std::uint32_t>(triangles.size());
  meshes.push_back({first, static_cast<std::uint32_t>(count), mask, opacity});

  const detail::DefaultFloatMode mode;
  mesh_of.append(count, static_cast<std::uint32_t>(meshes.size() - 1));
  for (std::size_t i = 0; i < count; ++i) {
    triangles.push_back(triangle_at(i));
    keep_or_drop(triangles.back(), first + static_cast<std::uint32_t>(i));
  }
  stats.triangles += count;
}

Status Scene::add(const MeshView& mesh, std::uint32_t* mesh_id) {
  try {
    if (!impl_) impl_ = std::make_unique<Impl>();
    Impl& s = *impl_;
    if (s.committed) return {StatusCode::invalid_argument, "scene: already committed"};
    if (Status status = detail::check(mesh); !status) return status;
    if (Status status = check_count(s.triangles.size(), mesh.triangle_count); !status) return status;
    s.append(mesh.triangle_count, mesh.mask, mesh.opacity, [&](std::size_t i) { return detail::triangle_of(mesh, i); });
    if (mesh_id) *mesh_id = static_cast<std::uint32_t>(s.meshes.size() - 1);
    return {};
  } catch (const std::bad_alloc&) {
    return Status::out_of_memory("scene: out of memory while adding a mesh");
  }
}

Status Scene::add_prototype(const MeshView& mesh, std::uint32_t* prototype_id) {
  try {
    if (!impl_) impl_ = std::make_unique<Impl>();
    Impl& s = *impl_;
    if (s.committed) return {StatusCode::invalid_argument, "scene: already committed"};
    if (Status status = detail::check(mesh); !status) return status;
    if (Status status = check_count(0, mesh.triangle_count); !status) return status;
    const std::uint32_t number = s.instances.add_prototype(detail::Prototype(detail::triangles_of(mesh)));
    if (prototype_id) *prototype_id = number;
    return {};
  } catch (const std::bad_alloc&) {
    return Status::out_of_memory("scene: out of memory while adding a prototype");
  }
}

Status Scene::add_instance(const Instance& instance, std::uint32_t* mesh_id) {
  const std::size_t count = impl_ ? impl_->meshes.size() : 0;
  try {
    if (!impl_ || instance.prototype >= impl_->instances.prototype_count())
      return {StatusCode::invalid_argument, "scene: no prototype " + std::to_string(instance.prototype)};
    Impl& s = *impl_;
    if (s.committed) return {StatusCode::invalid_argument, "scene: already committed"};
    if (s.instances.size() >= kMaxInstances) return {StatusCode::resource_limit, "scene: more than 2^29 instances"};
    const detail::Prototype& prototype = s.instances.prototype(instance.prototype);
    const auto number = static_cast<std::uint32_t>(count);
    // What kernels see of an instance is a mesh of no triangles.
    s.meshes.push_back({static_cast<std::uint32_t>(s.triangles.size()), 0, 0xFFFFFFFFu, {}});
    if (s.instances.add(instance, number)) {
      s.stats.triangles += prototype.triangle_count();
      s.stats.instanced_triangles += prototype.triangle_count();
      s.stats.dropped_nonfinite += prototype.nonfinite_count();
    } else {
      s.meshes.pop_back();
      if (Status status = check_count(s.triangles.size(), prototype.triangle_count()); !status) return status;
      s.flattened.resize(s.instances.prototype_count());
      s.flattened[instance.prototype] = true;
      s.append(prototype.triangle_count(), instance.mask, instance.opacity,
               [&](std::size_t i) { return detail::placed(instance.to_world, prototype.triangles()[i]); });
    }
    if (mesh_id) *mesh_id = number;
    return {};
  } catch (const std::bad_alloc&) {
    if (impl_->meshes.size() > count) impl_->meshes.pop_back();
    return Status::out_of_memory("scene: out of memory while adding an instance");
  }
}

void Scene::Impl::make_view() {
  bool all_plain = true;
  for (const detail::MeshRecord& m : meshes) all_plain &= m.mask != 0 && !m.opacity.opaque;
  view = {&tree->tree(), triangles.data(), kept.data(), kept.size(), mesh_of.data(), meshes.data(),
          meshes.size(), all_plain,        nullptr,     &*tree,      &bvh,           &folded};
}

void Scene::Impl::build(const BuildOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  tree.emplace(triangles, kept, bounds, options.quality);
  const detail::Tree& around = tree->tree();
  bvh = detail::TriangleBvh(triangles.data(), kept.data(), kept.size(), around.scale_exponent, around.eps,
                            options.executor);
  folded = detail::FoldedBvh(bvh);
  stats.triangle_bytes = triangles.size() * sizeof(detail::Triangle);
  instances.build(options.executor);
  placed_bounds = bounds;
  bounds.extend(instances.bounds());
  stats.box_bytes = bvh.bytes() + folded.bytes();
  stats.instances = instances.size();
  stats.instance_bytes = instances.bytes();
  stats.bytes = stats.triangle_bytes + stats.box_bytes + stats.instance_bytes +
                (kept.size() + mesh_of.size()) * sizeof(std::uint32_t) + meshes.size() * sizeof(detail::MeshRecord);
  stats.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  tree->set_stats(stats);
  if (options.tree == TreeBuild::at_commit) tree->build(options.executor);
  make_view();
}

void Scene::Impl::make_side_table(KernelId kernel, const Training& training) {
  side_tables.resize(detail::kernel_table_size());
  std::shared_ptr<const detail::SideTable>& slot = side_tables[detail::kernel_place(kernel)];
  slot.reset();
  slot = detail::kernel_at(kernel).prepare({view, training});
}

const detail::SceneView* detail::SceneAccess::view(const Scene& scene) noexcept {
  return scene.impl_ && scene.impl_->committed ? &scene.impl_->view : nullptr;
}

const detail::InstanceTree* detail::SceneAccess::instances(const Scene& scene) noexcept {
  return scene.impl_ && !scene.impl_->instances.empty() ? &scene.impl_->instances : nullptr;
}

std::shared_ptr<const detail::SideTable> detail::SceneAccess::default_side(const Scene& scene) noexcept {
  const auto& tables = scene.impl_->side_tables;
  const std::size_t place = kernel_place(KernelId{});
  return place < tables.size() ? tables[place] : nullptr;
}

Status Scene::commit(const BuildOptions& options) {
  try {
    if (!impl_) impl_ = std::make_unique<Impl>();
    Impl& s = *impl_;
    if (s.committed) return {StatusCode::invalid_argument, "scene: already committed"};
    s.build(options);
    s.committed = true;
    // Without its table, the default kernel answers each ray by itself.
    try {
      s.make_side_table(KernelId{}, {});
    } catch (const std::bad_alloc&) {
      s.side_tables.clear();
    }
    return {};
  } catch (const std::bad_alloc&) {
    impl_.reset();
    return Status::out_of_memory("scene: out of memory while building");
  } catch (const std::exception& e) {
    impl_.reset();
    return detail::parallel_failure("scene", options.executor, e);
  }
}

Status Scene::update(const SceneUpdate& update) {
  if (!impl_ || !impl_->committed) return {StatusCode::invalid_argument, "scene: not committed"};
  try {
    for (std::size_t i = 0; i < update.shape_count; ++i) {
      const SceneUpdate::Reshape& shape = update.shapes[i];
      if (Status status = detail::check(shape.mesh); !status) return status;
      if (Status status = check_count(0, shape.mesh.triangle_count); !status) return status;
      if (shape.prototype < impl_->flattened.size() && impl_->flattened[shape.prototype])
        return {StatusCode::invalid_argument, "scene: not all instances of the prototype have stayed such"};
    }
    detail::InstanceTree next;
    if (!impl_->instances.updated(update, next))
      return {StatusCode::invalid_argument, "scene: the instances cannot be moved so; build a new scene"};
    impl_->instances = std::move(next);
    impl_->bounds = impl_->placed_bounds;
    impl_->bounds.extend(impl_->instances.bounds());
    return {};
  } catch (const std::bad_alloc&) {
    return Status::out_of_memory("scene: out of memory while moving instances");
  } catch (const std::exception& e) {
    return detail::parallel_failure("scene", update.executor, e);
  }
}

Status Scene::prepare(KernelId kernel, const Training& training, PrepareStats* stats) {
  if (stats) *stats = {};
  if (!impl_ || !impl_->committed) return {StatusCode::invalid_argument, "scene: not committed"};
  const detail::Kernel& entry = detail::kernel_at(kernel);
  if (!entry.prepare && !entry.needs_tree) return {};
  try {
    impl_->tree->build(training.executor);
    if (!entry.prepare) return {};
    const auto start = std::chrono::steady_clock::now();
    impl_->make_side_table(kernel, training);
    if (stats) stats->seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (stats) stats->bytes = prepared_bytes(kernel);
    return {};
  } catch (const std::bad_alloc&) {
    return Status::out_of_memory("scene: out of memory while preparing a kernel");
  } catch (const std::exception& e) {
    return detail::parallel_failure("scene", training.executor, e);
  }
}

std::uint64_t Scene::prepared_bytes(KernelId kernel) const noexcept {
  const detail::SideTable* side = impl_ && impl_->committed ? impl_->view_for(kernel).side : nullptr;
  return side ? side->bytes() : 0;
}

bool Scene::occluded(const Ray& ray, const QueryOptions& options) const noexcept {
  std::uint8_t out = 0;
  occluded(RaySpan{&ray, 1, sizeof(Ray)}, &out, options);
  return out != 0;
}

void Scene::occluded(RaySpan rays, std::uint8_t* out, const QueryOptions& options) const noexcept {
  if (!impl_ || !impl_->committed) {
    std::fill(out, out + rays.count, std::uint8_t{0});
    return;
  }
  const detail::SceneView& view = impl_->view_for(options.kernel);
  const detail::EntryPoints& kernel = impl_->entry_points(options.kernel);
  const bool is_shared = options.executor && kernel.shares_occluded;
  if (is_shared) kernel.occluded(view, rays, out, options);
  if (is_shared && impl_->instances.empty()) return;
  detail::for_blocks(rays, options, [&](RaySpan block, std::size_t first, const QueryOptions& here) {
    if (!is_shared) kernel.occluded(view, block, out + first, here);
    if (!impl_->instances.empty()) detail::add_instances(impl_->instances, block, out + first, here);
  });
}

void Scene::occluded(RaySpan rays, std::uint8_t* out, OcclusionCounts& counts,
                     const QueryOptions& options) const noexcept {
  if (!impl_ || !impl_->committed) {
    occluded(rays, out, options);
    return;
  }
  impl_->entry_points(options.kernel).occluded_counted(impl_->view_for(options.kernel), rays, out, options, counts);
  if (!impl_->instances.empty()) detail::add_instances(impl_->instances, rays, out, options, counts);
}

bool Scene::closest(const Ray& ray, Hit& hit, const QueryOptions& options) const noexcept {
  closest(RaySpan{&ray, 1, sizeof(Ray)}, &hit, options);
  return hit.valid();
}

void Scene::closest(RaySpan rays, Hit* out, const QueryOptions& options) const noexcept {
  if (!impl_ || !impl_->committed) {
    std::fill(out, out + rays.count, Hit{});
    return;
  }
  const detail::SceneView& view = impl_->view_for(options.kernel);
  detail::for_blocks(rays, options, [&](RaySpan block, std::size_t first, const QueryOptions& here) {
    impl_->entry_points(options.kernel).closest(view, block, out + first, here);
    if (!impl_->instances.empty())
      detail::add_closest_instances(impl_->instances, impl_->view, block, out + first, here);
  });
}

void Scene::closest(RaySpan rays, Hit* out, RayCounts& counts, const QueryOptions& options) const noexcept {
  if (!impl_ || !impl_->committed) {
    closest(rays, out, options);
    return;
  }
  impl_->entry_points(options.kernel).closest_counted(impl_->view_for(options.kernel), rays, out, options, counts);
  if (!impl_->instances.empty())
    detail::add_closest_instances(impl_->instances, impl_->view, rays, out, options, &counts);
}

const BuildStats& Scene::build_stats() const noexcept {
  static const BuildStats none;
  return impl_ && impl_->committed ? impl_->tree->stats() : none;
}

bool Scene::bounds(float lower[3], float upper[3]) const noexcept {
  const bool any = impl_ && !impl_->bounds.empty();
  for (int k = 0; k < 3; ++k) {
    lower[k] = any ? impl_->bounds.lower[k] : 0;
    upper[k] = any ? impl_->bounds.upper[k] : 0;
  }
  return any;
}

}  // namespace umbrix
