// SPDX-License-Identifier: Apache-2.0
#include <hwy/targets.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "umbrix/kernel.h"

namespace umbrix {
namespace {

struct Target {
  std::int64_t bit;
  const char* name;
};

/// What the processor has and the build did not leave out, best (lowest bit) first.
const std::vector<Target>& targets() {
  static const std::vector<Target> list = [] {
    std::vector<Target> result;
    for (std::int64_t rest = hwy::SupportedTargets() & HWY_TARGETS; rest != 0; rest &= rest - 1) {
      const std::int64_t bit = rest & -rest;
      result.push_back({bit, hwy::TargetName(bit)});
    }
    return result;
  }();
  return list;
}

}  // namespace

std::size_t simd_target_count() noexcept { return targets().size(); }
const char* simd_target_name(std::size_t index) noexcept {
  return index < targets().size() ? targets()[index].name : "";
}

Status use_simd_target(const char* name) {
  std::int64_t mask = 0;
  std::string known;
  for (const Target& t : targets()) {
    if (!name || std::strcmp(t.name, name) == 0) mask |= t.bit;
    known += (known.empty() ? "" : ", ") + std::string(t.name);
  }
  if (mask == 0)
    return {StatusCode::invalid_argument,
            "no instruction set named '" + std::string(name) + "' here; there are: " + known};
  hwy::SetSupportedTargetsForTest(mask);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  return {};
}

}  // namespace umbrix
