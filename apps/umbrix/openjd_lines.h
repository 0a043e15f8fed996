// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace umbrix::app {

/// From now on failures are also told on stdout, as Open Job Description's sessions want it: "openjd_fail: ..." as the
/// last line (openjd-specifications, "How Jobs Are Run").
void use_openjd_lines() noexcept;

/// "openjd_progress: 12.5" and "openjd_status: text", flushed. Without a reader they are lost, which changes nothing.
void say_openjd_progress(double percent);
void say_openjd_status(const std::string& text);

/// "openjd_fail: text", if such lines are in use. Safe in a signal handler.
void say_openjd_failure(const char* text) noexcept;

}  // namespace umbrix::app
