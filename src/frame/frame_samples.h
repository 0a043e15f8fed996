// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tree/tree.h"
#include "umbrix/frame.h"

namespace umbrix::detail {

/// A share of a frame's rays, kept to learn from. What is learned does not depend on their order.
class FrameSamples {
 public:
  bool empty() const noexcept { return rays_.empty(); }
  void clear() noexcept { rays_.clear(); }

  /// Takes one ray in sixteen. Where there is no memory it takes fewer.
  void add(const ShadowTile& tile) noexcept;

  /// By node: the leaves that the rays cross.
  std::vector<bool> touched_leaves(const Tree& tree) const;

 private:
  std::vector<Ray> rays_;
};

}  // namespace umbrix::detail
