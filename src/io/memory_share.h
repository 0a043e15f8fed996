// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unistd.h>

#include <cstdint>
#include <limits>

namespace umbrix::io::detail {

/// A part of the machine's memory in bytes, for limits that end what a small file can ask for before the memory does.
inline std::uint64_t memory_share(std::uint64_t numerator, std::uint64_t denominator) {
  const long pages = ::sysconf(_SC_PHYS_PAGES), page_bytes = ::sysconf(_SC_PAGESIZE);
  if (pages <= 0 || page_bytes <= 0) return std::numeric_limits<std::int64_t>::max();
  return static_cast<std::uint64_t>(pages) / denominator * numerator * static_cast<std::uint64_t>(page_bytes);
}

}  // namespace umbrix::io::detail
