// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/node_tracks.h"
#include "io/shape.h"

namespace umbrix::io {

/// What moves a scene. Never changes once made, so copies of a scene share it.
class SceneMotion {
 public:
  /// Follows a node. `local`: its place in the node, if it has one there.
  struct MovedInstance {
    std::uint32_t instance = 0;
    std::uint32_t node = 0;  ///< in the tree
    std::shared_ptr<const glm::dmat4> local;
  };
  struct MovedLight {
    std::uint32_t light = 0;
    std::uint32_t node = 0;
    std::string label;
  };
  /// The nodes that carry vertices, and how those lie in each.
  struct Skin {
    std::vector<std::uint32_t> joints;  ///< in the tree
    std::vector<glm::dmat4> inverse_bind;
  };
  struct MovedMesh {
    std::uint32_t mesh = 0;
    std::vector<std::uint32_t> instances;  ///< of this mesh
    std::shared_ptr<const detail::Shape> shape;
    std::vector<double> weights;                       ///< at rest
    std::shared_ptr<const detail::NodeTracks> tracks;  ///< null, or may move the weights
    std::shared_ptr<const Skin> skin;                  ///< if the shape follows joints
  };

  std::shared_ptr<const detail::NodeTree> tree;
  std::vector<MovedInstance> instances;
  std::vector<MovedLight> lights;
  std::vector<MovedMesh> meshes;

  /// Without a time: at rest. Throws LoadError, and leaves the scene as it was.
  void pose(SceneFile& scene, std::optional<double> seconds, SceneChanges& changes) const;

  detail::KeySpan span() const;
};

}  // namespace umbrix::io
