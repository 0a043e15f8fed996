// SPDX-License-Identifier: Apache-2.0
#pragma once

#if defined(__SSE2__)
#include <immintrin.h>
#else
#include <cfenv>
#endif

namespace umbrix::detail {

/// Round-to-nearest with denormals for the lifetime of the object. Hosts may run with flush-to-zero, under which
/// the double test would lose denormal inputs (the float filter and the integers are immune).
class DefaultFloatMode {
 public:
#if defined(__SSE2__)
  DefaultFloatMode() noexcept : saved_(_mm_getcsr()) {
    if (differs()) _mm_setcsr(kDefault);
  }
  ~DefaultFloatMode() {
    if (differs()) _mm_setcsr(saved_);
  }

 private:
  static constexpr unsigned kDefault = 0x1f80;
  static constexpr unsigned kStickyFlags = 0x3f;
  bool differs() const noexcept { return (saved_ & ~kStickyFlags) != kDefault; }
  unsigned saved_;
#else
  DefaultFloatMode() noexcept {
    std::fegetenv(&saved_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~DefaultFloatMode() { std::fesetenv(&saved_); }

 private:
  std::fenv_t saved_;
#endif
 public:
  DefaultFloatMode(const DefaultFloatMode&) = delete;
  DefaultFloatMode& operator=(const DefaultFloatMode&) = delete;
};

}  // namespace umbrix::detail
