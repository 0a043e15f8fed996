// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "render/shared_meshes.h"
#include "umbrix/io/scene_file.h"
#include "umbrix/opacity.h"
#include "umbrix/scene.h"

namespace umbrix::render {

/// One instance in world space. Each position is transformed in double and rounded once to float, so a vertex
/// shared by triangles (or by meshes with equal transforms) has equal bits everywhere.
struct WorldMesh {
  std::uint32_t instance = 0;      ///< in SceneFile::instances
  const io::Mesh* mesh = nullptr;  ///< the triangles, normals and texture coordinates
  const io::Transform* to_world = nullptr;
  std::vector<io::Float3> positions;  ///< world space; empty if it shares its mesh
  bool mirrored = false;              ///< the transform turns counter-clockwise triangles into clockwise ones

  /// A vertex in world space.
  io::Float3 position(std::size_t vertex) const noexcept;

  /// If it does not share its mesh: the triangles as Scene::add and other tracers want them; valid while this and the
  /// file live.
  MeshView view() const noexcept;
};

/// The instances that are there, in file order. One that alpha hides for any ray, by what is known without textures, is
/// not (`notes` has one line for each kind of simplification). Those that share their mesh get no positions. `file`
/// must outlive the result. resource_limit if memory runs out.
Status flatten(const io::SceneFile& file, std::vector<WorldMesh>& out, std::vector<std::string>& notes,
               Instancing instancing = Instancing::flatten, bool moves = false);

/// What rays meet (alpha included) and what shading needs to know about it. `scene` mesh i is `meshes[i]`.
struct World {
  const io::SceneFile* file = nullptr;
  std::vector<WorldMesh> meshes;
  std::vector<std::string> notes;
  std::vector<AlphaTest> alpha;           ///< of the file's meshes that are not solid
  std::vector<OpacityTest> opacity;       ///< of `meshes`: none, or that of one in `alpha`
  std::vector<std::uint32_t> prototypes;  ///< of the file's meshes, in the scene; Primitive::kNone: not shared
  Scene scene;
};

/// Flattens and builds; `file` must outlive the world, and its textures are used as far as they are read by then.
/// `moves`: move_world is to come. Fails as flatten, Scene::add and Scene::commit do, naming the file.
Status build_world(const io::SceneFile& file, const BuildOptions& options, World& out,
                   Instancing instancing = Instancing::automatic, bool moves = false);

/// Follows a scene that io::pose_scene moved. What stayed is kept: where all that moved shares its meshes, instances
/// are moved in the scene, and what was prepared for it stays. Else it is placed anew and the scene `rebuilt`. Fails as
/// build_world, and leaves a world that nothing may be asked of.
Status move_world(const io::SceneChanges& changes, const BuildOptions& options, World& world, bool& rebuilt);

}  // namespace umbrix::render
