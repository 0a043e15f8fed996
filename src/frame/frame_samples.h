// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "index/primitive_index.h"
#include "kernels/scene_view.h"
#include "tree/tree.h"
#include "umbrix/frame.h"

namespace umbrix::detail {

/// A share of a frame's rays, kept to learn from. What is learned does not depend on their order.
class FrameSamples {
 public:
  bool empty() const noexcept { return samples_.empty(); }
  void clear() noexcept { samples_.clear(); }

  /// Takes one ray in sixteen. Where there is no memory it takes fewer.
  void add(const ShadowTile& tile) noexcept;

  /// By node: the leaves that the rays cross. Throws std::bad_alloc.
  std::vector<bool> touched_leaves(const Tree& tree) const;

  /// The lists of likely blockers that would have served these rays. Throws std::bad_alloc.
  std::unique_ptr<PrimitiveIndex> learned_index(const SceneView& scene, const Executor* executor) const;

 private:
  struct Sample {
    Ray ray;
    Primitive skip;
  };

  std::vector<Sample> samples_;
};

}  // namespace umbrix::detail
