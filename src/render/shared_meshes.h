// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "umbrix/io/scene_file.h"

namespace umbrix::render {

/// What becomes of meshes that have several instances. Pictures do not depend on it.
enum class Instancing {
  automatic,  ///< shared in scenes that would be large without; smaller ones are faster if all is placed
  flatten,    ///< each instance is placed: has vertices and triangles of its own
  share,      ///< instances share the mesh, but for small meshes
};

/// Of each of the file's meshes: do its instances share it? Also if there is but one, where the world `moves` (see
/// move_world) and that saves building the rest anew.
std::vector<bool> shared_meshes(const io::SceneFile& file, Instancing instancing, bool moves = false);

/// How large a world will be.
struct WorldSize {
  std::uint64_t placed_vertices = 0, placed_triangles = 0;
  std::uint64_t shared_triangles = 0;  ///< once for all the instances that share them
  std::uint64_t sharing_instances = 0;
};
WorldSize world_size(const io::SceneFile& file, Instancing instancing);

}  // namespace umbrix::render
