// SPDX-License-Identifier: Apache-2.0
#include "render/world.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <new>
#include <utility>

#include "render/materials/alpha.h"
#include "render/vec.h"

namespace umbrix::render {
namespace {

void copy(const io::Transform& from, double (&to)[3][4]) {
  for (std::size_t row = 0; row < 3; ++row) std::copy(from[row].begin(), from[row].end(), to[row]);
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

WorldMesh place(const io::SceneFile& file, std::uint32_t instance, bool shares) {
  const io::Transform& to_world = file.instances[instance].to_world;
  WorldMesh placed;
  placed.instance = instance;
  placed.mesh = &file.meshes[file.instances[instance].mesh];
  placed.to_world = &to_world;
  placed.mirrored = mirrors(to_world);
  if (shares) return placed;
  std::vector<io::Float3> positions;
  positions.reserve(placed.mesh->positions.size());
  for (std::size_t i = 0; i < placed.mesh->positions.size(); ++i) positions.push_back(placed.position(i));
  placed.positions = std::move(positions);
  return placed;
}

void note_alpha(const io::SceneFile& file, std::vector<std::string>& notes) {
  const auto blended = std::count_if(file.materials.begin(), file.materials.end(), [](const io::Material& material) {
    return material.alpha_mode == io::AlphaMode::blend && material.alpha > 0;
  });
  if (blended == 0) return;
  notes.push_back(fmt::format(
      "blended materials ({}) stop rays by chance, as their alpha says: more samples, less noise", blended));
}

MeshView triangles_of(const io::Mesh& mesh, const std::vector<io::Float3>& positions) {
  MeshView view;
  view.vertices = positions.data()->data();
  view.vertex_count = positions.size();
  view.indices = mesh.triangles.data()->data();
  view.triangle_count = mesh.triangles.size();
  return view;
}

/// Adds meshes, and for the first instance of each that is shared its prototype.
class SceneFiller {
 public:
  explicit SceneFiller(World& world) : file_(*world.file), scene_(world.scene), prototypes_(world.prototypes) {
    prototypes_.assign(file_.meshes.size(), Primitive::kNone);
  }

  Status add(const WorldMesh& mesh, const OpacityTest& opacity) {
    if (!mesh.positions.empty()) {
      MeshView view = mesh.view();
      view.opacity = opacity;
      return scene_.add(view);
    }
    std::uint32_t& prototype = prototypes_[file_.instances[mesh.instance].mesh];
    if (prototype == Primitive::kNone) {
      MeshView view = triangles_of(*mesh.mesh, mesh.mesh->positions);
      if (Status status = scene_.add_prototype(view, &prototype); !status) return status;
    }
    Instance instance;
    instance.prototype = prototype;
    copy(*mesh.to_world, instance.to_world);
    instance.opacity = opacity;
    return scene_.add_instance(instance);
  }

 private:
  const io::SceneFile& file_;
  Scene& scene_;
  std::vector<std::uint32_t>& prototypes_;
};

Status build_scene(const BuildOptions& options, World& world) {
  world.scene = Scene();  // the old tree goes before the new one comes
  SceneFiller filler(world);
  for (std::size_t i = 0; i < world.meshes.size(); ++i) {
    if (Status status = filler.add(world.meshes[i], world.opacity[i]); !status) return status;
  }
  return world.scene.commit(options);
}

/// Returns false if only a new scene will do.
bool update_scene(const io::SceneChanges& changes, const std::vector<SceneUpdate::Move>& moves,
                  const BuildOptions& options, World& world) {
  std::vector<SceneUpdate::Reshape> shapes;
  for (const std::uint32_t number : changes.meshes) {
    if (world.prototypes[number] == Primitive::kNone) continue;
    const io::Mesh& mesh = world.file->meshes[number];
    shapes.push_back({world.prototypes[number], triangles_of(mesh, mesh.positions)});
  }
  SceneUpdate update;
  update.moves = moves.data();
  update.move_count = moves.size();
  update.shapes = shapes.data();
  update.shape_count = shapes.size();
  update.executor = options.executor;
  return world.scene.update(update).ok();
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

io::Float3 WorldMesh::position(std::size_t vertex) const noexcept {
  if (!positions.empty()) return positions[vertex];
  double m[3][4];
  copy(*to_world, m);
  io::Float3 result;
  transform_point(m, mesh->positions[vertex].data(), result.data());
  return result;
}

MeshView WorldMesh::view() const noexcept { return triangles_of(*mesh, positions); }

Status flatten(const io::SceneFile& file, std::vector<WorldMesh>& out, std::vector<std::string>& notes,
               Instancing instancing, bool moves) try {
  out.clear();
  notes.clear();
  note_alpha(file, notes);
  const std::vector<bool> shared = shared_meshes(file, instancing, moves);
  for (std::uint32_t i = 0; i < file.instances.size(); ++i) {
    const io::Mesh& mesh = file.meshes[file.instances[i].mesh];
    if (mesh.triangles.empty() || invisible(file.materials[mesh.material], mesh)) continue;
    out.push_back(place(file, i, shared[file.instances[i].mesh]));
  }
  return {};
} catch (const std::bad_alloc&) {
  return Status::out_of_memory("no memory for the placed vertices");
}

Status build_world(const io::SceneFile& file, const BuildOptions& options, World& out, Instancing instancing,
                   bool moves) {
  out = World();
  out.file = &file;
  if (Status status = flatten(file, out.meshes, out.notes, instancing, moves); !status) return status;
  if (Status status = make_opacity(file, out.meshes, out.alpha, out.opacity); !status) return named(file, status);
  return named(file, build_scene(options, out));
}

Status move_world(const io::SceneChanges& changes, const BuildOptions& options, World& world, bool& rebuilt) try {
  rebuilt = false;
  if (changes.instances.empty()) return {};
  bool all_share = true;
  std::vector<SceneUpdate::Move> moves;
  for (std::size_t i = 0; i < world.meshes.size(); ++i) {
    WorldMesh& mesh = world.meshes[i];
    if (!std::binary_search(changes.instances.begin(), changes.instances.end(), mesh.instance)) continue;
    const bool shares = mesh.positions.empty();
    all_share &= shares;
    mesh = place(*world.file, mesh.instance, shares);
    SceneUpdate::Move& move = moves.emplace_back();
    move.mesh = static_cast<std::uint32_t>(i);
    copy(*mesh.to_world, move.to_world);
  }
  if (all_share && update_scene(changes, moves, options, world)) return {};
  rebuilt = true;
  return named(*world.file, build_scene(options, world));
} catch (const std::bad_alloc&) {
  return Status::out_of_memory("no memory for the placed vertices");
}

}  // namespace umbrix::render
