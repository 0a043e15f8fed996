// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "kernels/scene_view.h"
#include "workload/geometry.h"

namespace umbrix::workload {

/// A scene from within: the same tree as `Scene` makes, open to look at.
class InnerScene {
 public:
  explicit InnerScene(const Geometry& geometry);
  InnerScene(const InnerScene&) = delete;
  InnerScene& operator=(const InnerScene&) = delete;

  /// As kernels see it, with a side table or none.
  detail::SceneView view(const detail::SideTable* side = nullptr) const;

 private:
  std::vector<detail::Triangle> triangles_;
  std::vector<std::uint32_t> kept_;
  std::vector<std::uint32_t> mesh_of_;
  std::vector<detail::MeshRecord> meshes_;
  detail::Tree tree_;
};

}  // namespace umbrix::workload
