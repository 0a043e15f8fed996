// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <vector>

#include "io/accessor.h"
#include "io/gltf_convert.h"
#include "io/node_tracks.h"

namespace umbrix::io::detail {

/// Which of a file's animations are played, and what they do to nodes. All are, but those that move what an earlier one
/// moves: exporters put each object's animation into one of its own, and each action of a character into one for all of
/// its joints, of which no two may be mixed.
class Animations {
 public:
  /// `wanted`: a name or number of the only animation to be played, or empty. Throws LoadError if there is none such.
  Animations(Conversion& conversion, const std::string& wanted);

  /// Reads and checks what is played on the nodes that `matters` is not zero of.
  void read(const std::vector<char>& matters);

  /// Null if no animation moves the node.
  std::shared_ptr<const NodeTracks> tracks(std::size_t node) const;

 private:
  using Channel = tinygltf::AnimationChannel;

  void choose(const std::string& wanted);
  void read_channel(std::size_t animation, const Channel& channel);
  KeyTimes times(int accessor, const std::string& label);
  template <class V, std::size_t N>
  KeyTrack<V> track(std::size_t animation, const Channel& channel, std::size_t count, AccessorUse use);
  std::size_t morph_targets(std::size_t node) const;

  Conversion& c_;
  AccessorReader reader_;
  std::vector<char> played_;
  std::map<std::size_t, std::shared_ptr<NodeTracks>> tracks_;  // by node
  std::map<int, KeyTimes> times_;                              // by accessor
};

}  // namespace umbrix::io::detail
