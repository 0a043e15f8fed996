// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <cstdlib>

namespace umbrix::fuzz {

/// What must hold for any input: if it does not, says what and ends the process, which fuzzers and tests take for a
/// crash.
inline void promise(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "broken promise: %s\n", what);
  std::abort();
}

}  // namespace umbrix::fuzz
