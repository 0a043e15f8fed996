// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdlib>

namespace umbrix {

/// How many rays a test takes: UMBRIX_TEST_RAYS if set, for runs under sanitizers or longer ones, else `usual`.
inline std::size_t test_rays(std::size_t usual) {
  const char* text = std::getenv("UMBRIX_TEST_RAYS");
  const long long count = text == nullptr ? 0 : std::atoll(text);
  return count > 0 ? static_cast<std::size_t>(count) : usual;
}

}  // namespace umbrix
