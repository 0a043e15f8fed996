// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "umbrix/executor.h"
#include "umbrix/export.h"
#include "umbrix/mesh.h"

namespace umbrix {

/// A prototype's mesh placed in the world (Scene::add_instance).
struct Instance {
  std::uint32_t prototype = 0;  ///< as Scene::add_prototype numbers them
  /// Affine, row-major: point' = to_world[row][0..2] . point + to_world[row][3], as transform_point rounds it.
  double to_world[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
  std::uint32_t mask = 0xFFFFFFFFu;  ///< as in MeshView; the prototype's own does not count
  OpacityTest opacity;               ///< the same
};

/// What moves in a committed scene (Scene::update).
struct SceneUpdate {
  /// Another place for the instance that is mesh number `mesh`.
  struct Move {
    std::uint32_t mesh = 0;
    double to_world[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
  };
  /// Other triangles for a prototype. Each of its instances needs a move, to where it is if it stays.
  struct Reshape {
    std::uint32_t prototype = 0;
    MeshView mesh;
  };

  const Move* moves = nullptr;
  std::size_t move_count = 0;
  const Reshape* shapes = nullptr;
  std::size_t shape_count = 0;
  const Executor* executor = nullptr;  ///< null: oneTBB
};

/// Where an instance has a vertex: in double, from left to right and without fused products, and each coordinate
/// rounded to float once.
UMBRIX_API void transform_point(const double to_world[3][4], const float local[3], float world[3]) noexcept;

}  // namespace umbrix
