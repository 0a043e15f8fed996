// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "render/vec.h"
#include "umbrix/io/scene_file.h"

namespace umbrix::render {

/// A point of a mesh, and what its vertices have there.
struct MeshPoint {
  const io::SceneFile& file;
  const io::Mesh& mesh;
  std::uint32_t triangle;
  double b[3];  ///< barycentric coordinates

  const io::Material& material() const { return file.materials[mesh.material]; }

  /// Between the values of the triangle's corners, one of `values` for each vertex.
  template <class Value, std::size_t N>
  void blend(const std::vector<std::array<Value, N>>& values, double (&out)[N]) const {
    const std::array<std::uint32_t, 3>& corners = mesh.triangles[triangle];
    for (std::size_t c = 0; c < N; ++c) {
      out[c] = 0;
      for (std::size_t k = 0; k < 3; ++k) out[c] += b[k] * static_cast<double>(values[corners[k]][c]);
    }
  }
};

}  // namespace umbrix::render
