// SPDX-License-Identifier: Apache-2.0
#include "render/world.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <new>

#include "render/materials/alpha.h"
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

/// Whether alpha is known to let all rays through: textures have none above 1.
bool invisible(const io::Material& material, const io::Mesh& mesh) {
  if (material.alpha_mode == io::AlphaMode::blend) return material.alpha == 0;
  return material.alpha_mode == io::AlphaMode::mask && material.alpha < material.alpha_cutoff && mesh.colors.empty();
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
  const auto blended = std::count_if(file.materials.begin(), file.materials.end(), [](const io::Material& material) {
    return material.alpha_mode == io::AlphaMode::blend && material.alpha > 0;
  });
  if (blended == 0) return;
  notes.push_back(
      fmt::format("blended materials ({}) stop rays by chance, as their alpha says: more samples, less noise", blended));
}

Status named(const io::SceneFile& file, const Status& status) {
  return status.ok() ? status : Status(status.code(), fmt::format("{}: {}", file.path, status.message()));
}

/// Opacity tests of the placed meshes. Instances share those of their mesh.
Status make_opacity(const io::SceneFile& file, const std::vector<WorldMesh>& meshes, std::vector<AlphaTest>& tests,
                    std::vector<OpacityTest>& out) try {
  std::map<const io::Mesh*, OpacityTest> known;
  for (const WorldMesh& mesh : meshes) {
    const auto [entry, is_new] = known.try_emplace(mesh.mesh);
    if (is_new && !is_solid(file, *mesh.mesh)) {
      const auto number = static_cast<std::uint64_t>(mesh.mesh - file.meshes.data());
      if (Status status = make_alpha_test(file, *mesh.mesh, number, tests.emplace_back()); !status) return status;
      entry->second = tests.back().test();
    }
    out.push_back(entry->second);
  }
  return {};
} catch (const std::bad_alloc&) {
  return Status::out_of_memory("no memory for alpha");
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
    if (mesh.triangles.empty() || invisible(file.materials[mesh.material], mesh)) continue;
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
  std::vector<OpacityTest> opacity;
  if (Status status = make_opacity(file, out.meshes, out.alpha, opacity); !status) return named(file, status);
  for (std::size_t i = 0; i < out.meshes.size(); ++i) {
    MeshView view = out.meshes[i].view();
    view.opacity = opacity[i];
    if (Status status = out.scene.add(view); !status) return named(file, status);
  }
  return named(file, out.scene.commit(options));
}

}  // namespace umbrix::render
