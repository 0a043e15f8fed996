// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/key_track.h"
#include "io/node_transform.h"

namespace umbrix::io::detail {

/// From the first to the last of some keys; empty while the first is above the last.
class KeySpan {
 public:
  void add(double first, double last);
  bool empty() const { return span_[0] > span_[1]; }
  std::array<double, 2> get() const { return empty() ? std::array<double, 2>{0, 0} : span_; }

 private:
  std::array<double, 2> span_ = {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
};

/// What animations do to one node.
struct NodeTracks {
  std::string label;
  Pose rest;
  std::optional<KeyTrack<glm::dvec3>> translation, scale;
  std::optional<KeyTrack<glm::dquat>> rotation;
  std::optional<KeyTrack<double>> weights;  ///< of the morph targets of the node's mesh

  bool moves() const { return translation || scale || rotation; }

  /// The node's place in its parent. Throws LoadError if the rotation has no length.
  glm::dmat4 matrix_at(double seconds) const;

  /// There must be some.
  std::vector<double> weights_at(double seconds) const;

  void widen(KeySpan& span) const;
};

/// The nodes that move, or that something that moves is below or bound to, parents first. Never changes once made.
struct NodeTree {
  struct Node {
    std::int32_t parent = -1;  ///< in `nodes`; below 0: bases[-1 - parent] is where its parent always is
    std::uint32_t number = 0;  ///< in the file
    glm::dmat4 rest = glm::dmat4(1);
    std::shared_ptr<const NodeTracks> tracks;  ///< null: stays at rest in its parent
  };
  std::vector<Node> nodes;
  std::vector<glm::dmat4> bases;

  /// Where a node is in the world; without a time at rest. Multiplied in the order of the walk at rest, so that a node
  /// that is moved to its place at rest changes no bit. Throws LoadError if it is not finite.
  glm::dmat4 to_world(std::size_t node, std::optional<double> seconds) const;

  /// The same of all nodes.
  std::vector<glm::dmat4> all_to_world(std::optional<double> seconds) const;

 private:
  glm::dmat4 local(const Node& node, std::optional<double> seconds) const;
  const glm::dmat4& base(const Node& node) const { return bases[static_cast<std::size_t>(-1 - node.parent)]; }
};

}  // namespace umbrix::io::detail
