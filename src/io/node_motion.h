// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "io/camera_motion.h"
#include "io/node_tracks.h"

namespace umbrix::io::detail {

/// A camera that follows a node.
class NodeMotion final : public CameraMotion {
 public:
  /// `node` in the tree; `label` for messages.
  NodeMotion(std::shared_ptr<const NodeTree> tree, std::size_t node, std::string label);

  void move(const Moment& moment, Camera& camera) const override;
  std::array<double, 2> span() const override;

 private:
  std::shared_ptr<const NodeTree> tree_;
  std::size_t node_;
  std::string label_;
};

}  // namespace umbrix::io::detail
