// SPDX-License-Identifier: Apache-2.0
#include "message.h"

#include <fmt/format.h>

#include <cstdio>

#include "log_file.h"

namespace umbrix::app {

std::string printable(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '?';
  }
  return text;
}

// fputs, not fmt::print: a closed stderr must not end the program with an exception.
void say(const std::string& text) {
  const std::string line = printable(text) + '\n';
  std::fputs(line.c_str(), stderr);
  std::fflush(stderr);
  log_line(line.c_str());
}

void say_error(const std::string& text) { say(fmt::format("umbrix: {}", text)); }

void say_warning(const std::string& text) { say(fmt::format("umbrix: warning: {}", text)); }

}  // namespace umbrix::app
