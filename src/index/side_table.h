// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace umbrix::detail {

/// What a kernel keeps beside the tree; each kernel that has one derives its own. It may change time, never answers.
class SideTable {
 public:
  SideTable() = default;
  virtual ~SideTable() = default;
  SideTable(const SideTable&) = delete;
  SideTable& operator=(const SideTable&) = delete;

  /// Memory held, growing tables as they stand now.
  virtual std::uint64_t bytes() const noexcept = 0;
};

}  // namespace umbrix::detail
