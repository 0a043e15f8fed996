// SPDX-License-Identifier: Apache-2.0
// A container's quota is in cpu.max of its control group or of a group around it (Linux, Documentation/admin-guide/
// cgroup-v2.rst): "QUOTA PERIOD" in microseconds, or "max PERIOD".
#include "thread_count.h"

#include <sched.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

namespace umbrix::app {
namespace {

int affinity_threads() {
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof set, &set) == 0) return CPU_COUNT(&set);
  return static_cast<int>(std::thread::hardware_concurrency());
}

/// The path after "0::" in /proc/self/cgroup; "/" if it cannot be told.
std::filesystem::path control_group() {
  std::ifstream file("/proc/self/cgroup");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("0::/", 0) == 0) return line.substr(3);
  }
  return "/";
}

int quota_threads(const std::filesystem::path& group, int otherwise) {
  std::ifstream file("/sys/fs/cgroup" + (group / "cpu.max").string());
  double quota = 0, period = 0;
  if (!(file >> quota >> period) || quota <= 0 || period <= 0) return otherwise;
  return std::max(1, static_cast<int>(std::ceil(quota / period)));
}

}  // namespace

int allowed_threads() {
  int threads = std::max(1, affinity_threads());
  for (std::filesystem::path group = control_group();; group = group.parent_path()) {
    threads = std::min(threads, quota_threads(group, threads));
    if (group == group.parent_path()) return threads;
  }
}

}  // namespace umbrix::app
