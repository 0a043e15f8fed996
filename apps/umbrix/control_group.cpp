// SPDX-License-Identifier: Apache-2.0
#include "control_group.h"

#include <fstream>
#include <string>

namespace umbrix::app {
namespace {

namespace fs = std::filesystem;

void add_with_parents(const std::string& root, fs::path group, std::vector<fs::path>& out) {
  for (;; group = group.parent_path()) {
    out.emplace_back(root + group.string());
    if (group == group.parent_path()) return;
  }
}

}  // namespace

std::vector<fs::path> control_groups(const std::string& controller) {
  std::vector<fs::path> groups;
  std::ifstream file("/proc/self/cgroup");
  // NUMBER:CONTROLLERS:PATH; version 2 names no controllers.
  for (std::string line; std::getline(file, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string named = line.substr(first + 1, second - first - 1), path = line.substr(second + 1);
    if (named.empty()) add_with_parents("/sys/fs/cgroup", path, groups);
    if (named == controller) add_with_parents("/sys/fs/cgroup/" + named, path, groups);
  }
  return groups;
}

}  // namespace umbrix::app
