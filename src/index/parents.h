// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "index/side_table.h"
#include "tree/tree.h"

namespace umbrix::detail {

/// By pair of siblings (a node's number halved): their parent. The root's is itself.
std::vector<std::uint32_t> parents_of_pairs(const Tree& tree);

/// The way up: by pair of siblings their parent and its cell. Sides on the root's box are infinite, since nothing
/// leaves through them (see LinkedLeaf).
class Parents : public SideTable {
 public:
  struct Parent {
    float faces[kFaces];
    std::uint32_t node;
  };

  /// Throws std::bad_alloc.
  explicit Parents(const Tree& tree);

  const Parent& of(std::uint32_t node) const noexcept { return pairs_[node / 2]; }
  std::uint64_t bytes() const noexcept override { return pairs_.size() * sizeof(Parent); }

 private:
  std::vector<Parent> pairs_;
};

}  // namespace umbrix::detail
