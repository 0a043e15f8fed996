// SPDX-License-Identifier: Apache-2.0
#include "memory_limit.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "control_group.h"
#include "strict_number.h"

namespace umbrix::app {
namespace {

/// "2G", "512M", "1.5GB", "2GiB" or plain bytes; powers of 1024, as Slurm and ulimit count.
bool parse_bytes(const std::string& text, std::uint64_t& out) {
  const std::string units = "KMGT";
  const std::size_t digits = std::min(text.find_first_not_of("0123456789."), text.size());
  const std::string unit = text.substr(digits);
  double factor = 1;
  if (!unit.empty()) {
    const std::size_t power = units.find(unit[0]);
    const std::string rest = unit.substr(1);
    if (power == std::string::npos || (!rest.empty() && rest != "B" && rest != "iB")) return false;
    for (std::size_t i = 0; i <= power; ++i) factor *= 1024;
  }
  double value = 0;
  if (!parse_number(text.substr(0, digits), value) || value * factor >= 0x1p63) return false;
  out = static_cast<std::uint64_t>(value * factor);
  return true;
}

/// A control group's limit; "max", and the largest number of pages in version 1, mean none.
std::uint64_t group_limit(const std::filesystem::path& group, std::uint64_t otherwise) {
  for (const char* name : {"memory.max", "memory.limit_in_bytes"}) {
    std::uint64_t bytes = 0;
    if (std::ifstream(group / name) >> bytes && bytes > 0) return std::min(bytes, otherwise);
  }
  return otherwise;
}

}  // namespace

std::uint64_t default_memory_limit() {
  const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
  if (pages <= 0 || page <= 0) return 0;
  std::uint64_t bytes = static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page);
  for (const std::filesystem::path& group : control_groups("memory")) bytes = group_limit(group, bytes);
  return bytes / 4 * 3;
}

void add_memory_limit_option(CLI::App& command, std::uint64_t& bytes) {
  const auto read = [&bytes](const std::string& text) {
    if (!parse_bytes(text, bytes))
      throw CLI::ValidationError(fmt::format("--memory-limit: '{}' is not a size such as 512M or 2G, or 0", text));
  };
  command
      .add_option_function<std::string>("--memory-limit", read,
                                        "End with exit code 6 rather than hold more memory than this; 0: no limit [3/4 "
                                        "of the machine's or container's]")
      ->type_name("SIZE");
}

}  // namespace umbrix::app
