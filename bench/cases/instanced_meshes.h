// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cases/meshes.h"
#include "umbrix/umbrix.h"

namespace umbrix::cases {

/// What instances' transforms are like.
enum class Placing {
  rigid,     ///< turned and moved
  sheared,   ///< any matrix with entries up to 2
  mirrored,  ///< turned, moved, and one axis the other way
  scaled,    ///< each instance by another factor from 1e-30 to 1e30
  squashed,  ///< by another factor along each axis, 1e-6 to 1e6
  flat,      ///< into a plane, a line or a point
  far,       ///< moved 1e2 to 1e9 extents away: float leaves less and less of the mesh
  overflow,  ///< some vertices beyond float's range, or an entry that is no number
};
inline constexpr Placing kPlacings[] = {Placing::rigid,    Placing::sheared, Placing::mirrored, Placing::scaled,
                                        Placing::squashed, Placing::flat,    Placing::far,      Placing::overflow};
std::string name_of(Placing placing);

/// Meshes and instances of two others in turn, added as such and as what they come to in the world.
class InstancedMeshes {
 public:
  InstancedMeshes(Placing placing, std::uint64_t seed);

  /// Instances as such.
  Status build_instanced(Scene& scene) const;
  /// Each instance as a mesh of its own, of placed vertices.
  Status build_flat(Scene& scene) const;

  std::uint32_t mesh_count() const { return static_cast<std::uint32_t>(world_.size()); }
  /// All triangles of the world in order, with those that nothing can hit.
  const Triangles& triangles() const { return all_; }
  Primitive primitive(std::uint32_t triangle) const;

  /// At vertices, edges and insides of the world's triangles, along their planes, from their surfaces and from far off,
  /// with ends at what they meet; and some that are not valid.
  std::vector<Ray> rays(std::size_t count, std::uint64_t seed) const;

  /// Do masks and opacity tests differ from mesh to mesh?
  bool is_filtered = false;

 private:
  struct Part {
    bool is_instance;
    Instance instance;  ///< its prototype is 0 or 1
    Triangles local;    ///< of a mesh
  };

  std::uint32_t mask_of(std::size_t part) const;
  OpacityTest opacity_of(std::size_t part) const;

  Triangles prototypes_[2];
  std::vector<Part> parts_;
  std::vector<Triangles> world_;
  Triangles all_;
  std::vector<std::uint32_t> targets_;  ///< triangles that are finite
};

}  // namespace umbrix::cases
