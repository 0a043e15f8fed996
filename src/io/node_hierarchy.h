// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "io/gltf_convert.h"

namespace umbrix::io::detail {

/// The nodes of the scene that is shown, checked to be trees (glTF 2.0, section 3.5).
class NodeHierarchy {
 public:
  /// A node on the walk. `parent`: its place in the walk, or -1.
  struct Step {
    std::uint32_t node = 0;
    std::int32_t parent = -1;
    std::uint32_t depth = 0;
    bool shown = true;  ///< false: it is there for the joints of a skin only
  };

  /// Throws LoadError.
  explicit NodeHierarchy(const Conversion& conversion);

  /// Parents before their children, children in the file's order.
  const std::vector<Step>& walk() const { return walk_; }

  /// Adds the trees of nodes that are not among those shown.
  void include(const std::vector<int>& nodes);

  /// A node's place in the walk; -1 if it is not there.
  std::int32_t place(std::size_t node) const { return place_[node]; }

  /// Marks a node and all above it.
  void mark_path(std::size_t node, std::vector<char>& marks) const;

 private:
  void find_parents();
  void refuse_cycles() const;
  std::vector<int> scene_roots() const;
  void walk_from(const std::vector<int>& roots, bool shown);

  const tinygltf::Model& model_;
  std::uint32_t most_depth_;
  std::vector<int> parent_;
  std::vector<Step> walk_;
  std::vector<std::int32_t> place_;
};

}  // namespace umbrix::io::detail
