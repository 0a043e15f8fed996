// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "oracle/exact_hit.h"
#include "umbrix/io/scene_file.h"
#include "umbrix/mesh.h"
#include "umbrix/scene.h"
#include "umbrix/status.h"

namespace umbrix::workload {

/// A mesh in world space.
struct WorldTriangles {
  std::vector<io::Float3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// A scene file's geometry, the same for every peer: zero-area triangles are left out, so that none has to sort them.
struct Geometry {
  std::string name;  ///< the file's name without folder and extension
  std::string path;
  io::SceneFile file;
  std::vector<WorldTriangles> meshes;

  std::size_t triangle_count() const;
  std::vector<MeshView> views() const;
  oracle::Triangle triangle(Primitive primitive) const;
  /// All triangles in order.
  std::vector<oracle::Triangle> triangle_list() const;
};

Status load_geometry(const std::string& path, Geometry& out);

/// Adds all meshes and commits.
Status build_scene(const std::vector<MeshView>& meshes, const BuildOptions& options, Scene& out);

}  // namespace umbrix::workload
