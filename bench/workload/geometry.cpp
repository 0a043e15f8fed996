// SPDX-License-Identifier: Apache-2.0
#include "workload/geometry.h"

#include <filesystem>
#include <utility>

#include "render/world.h"

namespace umbrix::workload {
namespace {

// Differences of floats and their products are exact in double but for extreme ranges.
bool has_area(const io::Float3& a, const io::Float3& b, const io::Float3& c) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const double left = (double{b[i]} - a[i]) * (double{c[j]} - a[j]);
    const double right = (double{b[j]} - a[j]) * (double{c[i]} - a[i]);
    if (left != right) return true;
  }
  return false;
}

}  // namespace

std::size_t Geometry::triangle_count() const {
  std::size_t count = 0;
  for (const WorldTriangles& mesh : meshes) count += mesh.triangles.size();
  return count;
}

std::vector<MeshView> Geometry::views() const {
  std::vector<MeshView> result;
  for (const WorldTriangles& mesh : meshes) {
    MeshView view;
    view.vertices = mesh.positions.empty() ? nullptr : mesh.positions[0].data();
    view.vertex_count = mesh.positions.size();
    view.indices = mesh.triangles.empty() ? nullptr : mesh.triangles[0].data();
    view.triangle_count = mesh.triangles.size();
    result.push_back(view);
  }
  return result;
}

oracle::Triangle Geometry::triangle(Primitive primitive) const {
  const WorldTriangles& mesh = meshes[primitive.mesh];
  oracle::Triangle result{};
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const io::Float3& p = mesh.positions[mesh.triangles[primitive.triangle][corner]];
    for (std::size_t k = 0; k < 3; ++k) result.v[corner][k] = p[k];
  }
  return result;
}

std::vector<oracle::Triangle> Geometry::triangle_list() const {
  std::vector<oracle::Triangle> result;
  result.reserve(triangle_count());
  for (std::uint32_t m = 0; m < meshes.size(); ++m) {
    for (std::uint32_t t = 0; t < meshes[m].triangles.size(); ++t) result.push_back(triangle({m, t}));
  }
  return result;
}

Status load_geometry(const std::string& path, Geometry& out) {
  out = {};
  out.path = path;
  out.name = std::filesystem::path(path).stem().string();
  if (Status status = io::load_scene(path, out.file); !status) return status;
  std::vector<render::WorldMesh> world;
  std::vector<std::string> notes;
  if (Status status = render::flatten(out.file, world, notes); !status) return status;
  for (render::WorldMesh& mesh : world) {
    WorldTriangles kept{std::move(mesh.positions), {}};
    for (const auto& t : mesh.mesh->triangles) {
      if (has_area(kept.positions[t[0]], kept.positions[t[1]], kept.positions[t[2]])) kept.triangles.push_back(t);
    }
    if (!kept.triangles.empty()) out.meshes.push_back(std::move(kept));
  }
  return {};
}

Status build_scene(const std::vector<MeshView>& meshes, const BuildOptions& options, Scene& out) {
  Scene scene;
  for (const MeshView& mesh : meshes) {
    if (Status status = scene.add(mesh); !status) return status;
  }
  if (Status status = scene.commit(options); !status) return status;
  out = std::move(scene);
  return {};
}

}  // namespace umbrix::workload
