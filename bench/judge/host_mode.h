// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cfenv>

#include "cases/cases.h"

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace umbrix::judge {

/// Makes this thread a host that has set another floating-point mode, for the lifetime of the object.
class HostModeScope {
 public:
  explicit HostModeScope(cases::HostMode mode) {
    std::fegetenv(&saved_);
    switch (mode) {
      case cases::HostMode::usual:
        break;
      case cases::HostMode::flush_denormals:
#if defined(__SSE2__)
        _mm_setcsr(_mm_getcsr() | 0x8040u);  // flush to zero, denormals are zero
#endif
        break;
      case cases::HostMode::round_up:
        std::fesetround(FE_UPWARD);
        break;
      case cases::HostMode::round_down:
        std::fesetround(FE_DOWNWARD);
        break;
      case cases::HostMode::round_to_zero:
        std::fesetround(FE_TOWARDZERO);
        break;
    }
  }
  ~HostModeScope() { std::fesetenv(&saved_); }
  HostModeScope(const HostModeScope&) = delete;
  HostModeScope& operator=(const HostModeScope&) = delete;

 private:
  std::fenv_t saved_;
};

}  // namespace umbrix::judge
