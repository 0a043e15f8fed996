// SPDX-License-Identifier: Apache-2.0
// A container's quota is in cpu.max of its control group or of a group around it (Linux, Documentation/admin-guide/
// cgroup-v2.rst): "QUOTA PERIOD" in microseconds, or "max PERIOD".
#include "thread_count.h"

#include <sched.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <thread>

#include "control_group.h"

namespace umbrix::app {
namespace {

int affinity_threads() {
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof set, &set) == 0) return CPU_COUNT(&set);
  return static_cast<int>(std::thread::hardware_concurrency());
}

int quota_threads(const std::filesystem::path& group, int otherwise) {
  std::ifstream file(group / "cpu.max");
  double quota = 0, period = 0;
  if (!(file >> quota >> period) || quota <= 0 || period <= 0) return otherwise;
  return std::max(1, static_cast<int>(std::ceil(quota / period)));
}

}  // namespace

int allowed_threads() {
  int threads = std::max(1, affinity_threads());
  for (const std::filesystem::path& group : control_groups("cpu")) {
    threads = std::min(threads, quota_threads(group, threads));
  }
  return threads;
}

}  // namespace umbrix::app
