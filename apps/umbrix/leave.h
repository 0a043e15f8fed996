// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace umbrix::app {

/// Ends the program from anywhere, a signal handler included: says the text on stderr and in the log, which may be
/// null, and removes what is half-written. Needs no memory.
[[noreturn]] void leave_at_once(const char* text, int code) noexcept;

}  // namespace umbrix::app
