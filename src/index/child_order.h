// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "index/side_table.h"
#include "tree/tree.h"

namespace umbrix::detail {

/// One bit for each node: which child goes first, whatever the ray.
class ChildOrder : public SideTable {
 public:
  /// Low children first. Throws std::bad_alloc.
  explicit ChildOrder(const Tree& tree) : bits_((tree.nodes.size() + 63) / 64) {}

  void set_high_first(std::uint32_t node) noexcept { bits_[node / 64] |= std::uint64_t{1} << (node % 64); }
  bool is_high_first(std::uint32_t node) const noexcept { return ((bits_[node / 64] >> (node % 64)) & 1u) != 0; }

  std::uint64_t bytes() const noexcept override { return bits_.size() * sizeof(bits_[0]); }

 private:
  std::vector<std::uint64_t> bits_;
};

}  // namespace umbrix::detail
