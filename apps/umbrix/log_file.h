// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "umbrix/status.h"

namespace umbrix::app {

/// Adds --log-file.
void add_log_file_option(CLI::App& command, std::string& path);

/// From now on all that the program says goes to the end of this file too. Nothing for an empty path; output_failed
/// names the file and the reason.
Status open_log(const std::string& path);

/// Appends a line, without its end or with it, and with the time before it. Nothing if no log is open; what cannot be
/// written is lost, as it is on a full standard error. Needs no memory, and is safe in a signal handler.
void log_line(const char* text) noexcept;

}  // namespace umbrix::app
