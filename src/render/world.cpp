// SPDX-License-Identifier: Apache-2.0
#include "render/world.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>

#include "render/vec.h"

namespace umbrix::render {
namespace {

io::Float3 transform_point(const io::Transform& m, const io::Float3& p) {
  io::Float3 result;
  for (std::size_t row = 0; row < 3; ++row) {
    result[row] = static_cast<float>(m[row][0] * p[0] + m[row][1] * p[1] + m[row][2] * p[2] + m[row][3]);
  }
  return result;
}

bool mirrors(const io::Transform& m) {
  return glm::determinant(glm::dmat3(m[0][0], m[0][1], m[0][2], m[1][0], m[1][1], m[1][2], m[2][0], m[2][1], m[2][2])) <
         0;
}

bool invisible(const io::Material& material) {
  return material.alpha_mode == io::AlphaMode::mask && material.alpha < material.alpha_cutoff;
}

WorldMesh place(const io::SceneFile& file, std::uint32_t instance) {
  const io::Transform& to_world = file.instances[instance].to_world;
  WorldMesh placed;
  placed.instance = instance;
  placed.mesh = &file.meshes[file.instances[instance].mesh];
  placed.mirrored = mirrors(to_world);
  placed.positions.reserve(placed.mesh->positions.size());
  for (const io::Float3& p : placed.mesh->positions) placed.positions.push_back(transform_point(to_world, p));
  return placed;
}

void note_alpha(const io::SceneFile& file, std::vector<std::string>& notes) {
  std::size_t blended = 0, masked_by_texture = 0;
  for (const io::Material& material : file.materials) {
    blended += material.alpha_mode == io::AlphaMode::blend;
    masked_by_texture += material.alpha_mode == io::AlphaMode::mask && material.base_color_texture >= 0;
  }
  if (blended > 0) notes.push_back(fmt::format("{} blended materials are rendered opaque", blended));
  if (masked_by_texture > 0) {
    notes.push_back(fmt::format("{} alpha masks are taken from the material's constant alpha: textures are not read",
                                masked_by_texture));
  }
}

Status build_scene(const BuildOptions& options, World& world) {
  world.scene = Scene();  // the old tree goes before the new one comes
  for (const WorldMesh& mesh : world.meshes) {
    if (Status status = world.scene.add(mesh.view()); !status) return status;
  }
  return world.scene.commit(options);
}

Status named(const io::SceneFile& file, const Status& status) {
  return status.ok() ? status : Status(status.code(), fmt::format("{}: {}", file.path, status.message()));
}

}  // namespace

MeshView WorldMesh::view() const noexcept {
  MeshView view;
  view.vertices = positions.data()->data();
  view.vertex_count = positions.size();
  view.indices = mesh->triangles.data()->data();
  view.triangle_count = mesh->triangles.size();
  return view;
}

Status flatten(const io::SceneFile& file, std::vector<WorldMesh>& out, std::vector<std::string>& notes) try {
  out.clear();
  notes.clear();
  note_alpha(file, notes);
  for (std::uint32_t i = 0; i < file.instances.size(); ++i) {
    const io::Mesh& mesh = file.meshes[file.instances[i].mesh];
    if (mesh.triangles.empty() || invisible(file.materials[mesh.material])) continue;
    out.push_back(place(file, i));
  }
  return {};
} catch (const std::bad_alloc&) {
  return Status::out_of_memory("no memory for the placed vertices");
}

Status build_world(const io::SceneFile& file, const BuildOptions& options, World& out) {
  out = World();
  out.file = &file;
  if (Status status = flatten(file, out.meshes, out.notes); !status) return status;
  return named(file, build_scene(options, out));
}

Status move_world(const io::SceneChanges& changes, const BuildOptions& options, World& world) try {
  if (changes.instances.empty()) return {};
  for (WorldMesh& mesh : world.meshes) {
    if (!std::binary_search(changes.instances.begin(), changes.instances.end(), mesh.instance)) continue;
    mesh = place(*world.file, mesh.instance);
  }
  return named(*world.file, build_scene(options, world));
} catch (const std::bad_alloc&) {
  return Status::out_of_memory("no memory for the placed vertices");
}

}  // namespace umbrix::render
