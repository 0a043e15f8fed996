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
  for (const cases::Case& c : cases::all_cases()) names.push_back(c.name);
  return names;
}

inline std::string case_test_name(const testing::TestParamInfo<const char*>& parameter) { return parameter.param; }

}  // namespace umbrix
