// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "io/accessor.h"
#include "io/gltf_convert.h"

namespace umbrix::io::detail {

struct MovingNode;

/// A file's animations, as far as they move cameras: each camera by the first that moves a node on the way to it, since
/// exporters put each object's animation into one of its own. All else stays at rest.
class CameraAnimations {
 public:
  /// `parent` of each node, or -1; must outlive this.
  CameraAnimations(Conversion& conversion, const std::vector<int>& parent);

  /// What moves the camera at `node`; null if nothing does.
  std::shared_ptr<const CameraMotion> motion(std::size_t node);

  /// Says that something that is shown moves with `node`, for note_ignored.
  void mesh_at(std::size_t node) { carry(node, kMesh); }
  void light_at(std::size_t node) { carry(node, kLight); }

  /// Notes which kinds of animation have no effect, once all nodes were seen.
  void note_ignored();

 private:
  enum Cargo : unsigned char { kMesh = 1, kLight = 2, kCamera = 4 };

  void carry(std::size_t node, Cargo cargo);
  std::vector<std::size_t> path_to(std::size_t node) const;
  int first_animation(const std::vector<std::size_t>& path) const;
  std::shared_ptr<const MovingNode> moving(std::size_t animation, std::size_t node);
  void read_channel(const tinygltf::Animation& animation, const tinygltf::AnimationChannel& channel,
                    const std::string& label, MovingNode& node);
  void note_channel(std::size_t animation, const tinygltf::AnimationChannel& channel);

  Conversion& c_;
  const std::vector<int>& parent_;
  AccessorReader reader_;
  std::map<std::size_t, std::vector<std::size_t>> animations_of_;  // node to animations, in the file's order
  std::map<std::pair<std::size_t, std::size_t>, std::shared_ptr<const MovingNode>> moving_;
  std::vector<unsigned char> cargo_;  // of each node and those below it
  std::size_t path_nodes_ = 0;        // of all motions
};

}  // namespace umbrix::io::detail
