// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cases/cases.h"

namespace umbrix {

/// For test suites that run once for each hard case.
inline std::vector<const char*> case_names() {
  std::vector<const char*> names;
  for (const cases::Case& c : cases::small_cases()) names.push_back(c.name.c_str());
  return names;
}

/// One of each kind, where all would take long.
inline std::vector<const char*> varied_case_names() {
  std::vector<const char*> names;
  for (const cases::Case& c : cases::small_cases()) {
    if (!c.is_variant) names.push_back(c.name.c_str());
  }
  return names;
}

inline std::string case_test_name(const testing::TestParamInfo<const char*>& parameter) {
  std::string name = parameter.param;
  for (char& c : name) c = c == '-' ? '_' : c;
  return name;
}

}  // namespace umbrix
