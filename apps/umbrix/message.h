// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace umbrix::app {

/// One line on stderr, and in the log file if there is one, "umbrix: ..." Control characters (from file names, say) are
/// shown as '?', so that no file can play with the terminal.
void say(const std::string& text);
void say_error(const std::string& text);
void say_warning(const std::string& text);

/// Control characters replaced.
std::string printable(std::string text);

}  // namespace umbrix::app
