// SPDX-License-Identifier: Apache-2.0
#include "error/machine.h"

#include <fmt/format.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>

#include "embree/embree_scene.h"
#include "umbrix/umbrix.h"

namespace umbrix::bench {
namespace {

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

std::string compiler() {
#if defined(__clang__)
  return "Clang " __clang_version__;
#elif defined(__GNUC__)
  return "GCC " __VERSION__;
#else
  return "unknown";
#endif
}

std::string system_name() {
  utsname name{};
  return uname(&name) == 0 ? fmt::format("{} {}", name.sysname, name.machine) : "unknown";
}

std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32] = "";
  std::strftime(text, sizeof(text), "%Y-%m-%d %H:%M UTC", &utc);
  return text;
}

}  // namespace

nlohmann::json machine_json() {
  return {{"processor", processor()},    {"cores", sysconf(_SC_NPROCESSORS_ONLN)},
          {"system", system_name()},     {"compiler", compiler()},
          {"umbrix", version_string()},  {"simd_target", simd_target_name(0)},
          {"embree", embree::version()}, {"date", today()}};
}

nlohmann::json load_json() {
  double loads[3];
  if (getloadavg(loads, 3) != 3) return nullptr;
  return {loads[0], loads[1], loads[2]};
}

}  // namespace umbrix::bench
