// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cfenv>

namespace umbrix::oracle {

/// Error bounds in double need IEEE rounding and denormals, whatever mode a host or a test has set.
class DefaultFloatMode {
 public:
  DefaultFloatMode() {
    std::fegetenv(&saved_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~DefaultFloatMode() { std::fesetenv(&saved_); }
  DefaultFloatMode(const DefaultFloatMode&) = delete;
  DefaultFloatMode& operator=(const DefaultFloatMode&) = delete;

 private:
  std::fenv_t saved_;
};

}  // namespace umbrix::oracle
