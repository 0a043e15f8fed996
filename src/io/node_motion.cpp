// SPDX-License-Identifier: Apache-2.0
#include "io/node_motion.h"

namespace umbrix::io::detail {

NodeMotion::NodeMotion(std::shared_ptr<const NodeTree> tree, std::size_t node, std::string label)
    : tree_(std::move(tree)), node_(node), label_(std::move(label)) {}

void NodeMotion::move(const Moment& moment, Camera& camera) const {
  camera.to_world = camera_frame(tree_->to_world(node_, moment.seconds), label_);
}

std::array<double, 2> NodeMotion::span() const {
  KeySpan span;
  for (auto n = static_cast<std::int32_t>(node_); n >= 0; n = tree_->nodes[static_cast<std::size_t>(n)].parent) {
    const NodeTree::Node& node = tree_->nodes[static_cast<std::size_t>(n)];
    if (node.tracks && node.tracks->moves()) node.tracks->widen(span);
  }
  return span.get();
}

}  // namespace umbrix::io::detail
