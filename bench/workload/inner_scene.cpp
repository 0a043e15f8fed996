// SPDX-License-Identifier: Apache-2.0
#include "workload/inner_scene.h"

#include "core/exact_test.h"
#include "tree/builder.h"

namespace umbrix::workload {

InnerScene::InnerScene(const Geometry& geometry) {
  for (std::uint32_t m = 0; m < geometry.meshes.size(); ++m) {
    const WorldTriangles& mesh = geometry.meshes[m];
    const auto first = static_cast<std::uint32_t>(triangles_.size());
    meshes_.push_back({first, static_cast<std::uint32_t>(mesh.triangles.size()), 0xFFFFFFFFu, {}});
    mesh_of_.resize(first + mesh.triangles.size(), m);
    for (const auto& corners : mesh.triangles) {
      detail::Triangle triangle;
      for (std::size_t k = 0; k < 3; ++k) {
        const io::Float3& p = mesh.positions[corners[k]];
        triangle.v[k] = {p[0], p[1], p[2]};
      }
      if (!detail::is_degenerate(triangle)) kept_.push_back(static_cast<std::uint32_t>(triangles_.size()));
      triangles_.push_back(triangle);
    }
  }
  BuildStats stats;
  tree_ = detail::build_tree(triangles_, kept_, BuildQuality::high, nullptr, stats);
}

detail::SceneView InnerScene::view(const detail::SideTable* side) const {
  return {&tree_,         triangles_.data(), kept_.data(), kept_.size(), mesh_of_.data(),
          meshes_.data(), meshes_.size(),    true,         side};
}

}  // namespace umbrix::workload
